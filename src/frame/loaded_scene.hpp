// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "features/common/placed_nodes.hpp"
#include "features/common/surface_map.hpp"
#include "features/lighting/lighting.hpp"
#include "features/lighting/lightmaps.hpp"
#include "features/shadows/sun.hpp"
#include "techniques/light/light.hpp"
#include "techniques/pose/pose.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/surface/materials.hpp"
#include "techniques/terrain/terrain_buffers.hpp"
#include "techniques/terrain/trails/trails.hpp"

namespace estampe::frame {

/// Everything of one scene that lives on the device, and the scene itself without its pictures.
struct LoadedScene {
    Scene scene;
    features::LightingOfScene own_lighting;    ///< lights and links as the file has them
    features::LightingOfScene styled_lighting; ///< lights and links as `scene` has them now
    std::optional<features::LightingWords>
        styled_by; ///< the style's words that `styled_lighting` was made by
    pose::MeshData layout;
    uint32_t layout_number = 0; ///< counts how often the scene was laid out
    std::vector<features::StillCaster>
        still_casters;                  ///< triangles of `layout` that never move and throw shadows
    Bounds still_room;                  ///< the box about all of `still_casters`
    pose::MeshBuffers meshes;           ///< `layout` on the device
    raster::ClusterBoxes cluster_boxes; ///< boxes about runs of triangles of `meshes`
    surface::MaterialBuffers materials;
    surface::SceneNeeds needs;
    std::vector<std::string> notes;           ///< what became of textures
    std::optional<Lightmap> lightmap;         ///< only where one was given
    std::optional<features::WornLight> baked; ///< `lightmap` laid on the triangles of `layout`
    std::optional<pose::PoseData> pose;       ///< the pose that the device holds; none after a new layout
    std::map<uint32_t, features::SurfaceMap>
        surface_maps; ///< maps that styles ask for, by their side in texels
    features::DefaultLight default_light;
    light::ExposureKeyCache exposure_key;
    features::PlacedNodes placed;                     ///< nodes that a program moves
    std::unique_ptr<terrain::TerrainBuffers> terrain; ///< null where the scene has no terrain
    std::unique_ptr<terrain::Footprints> footprints;  ///< null where the scene has no terrain
    bool terrain_moved = false;  ///< the terrain's vertices on the device are out of date
    bool has_plain_links = true; ///< every object stands to all lights alike
    bool pose_moved = true;      ///< the posed vertices on the device are out of date
};

/// Uploads `scene`, with a lightmap unless that is null. Throws Error when it does not fit the device, or
/// when the lightmap is another scene's.
[[nodiscard]] LoadedScene load_onto_device(gpu::Device& device, const Scene& scene, const Lightmap* lightmap);

/// The scene at a moment, what a program moves among it.
[[nodiscard]] ScenePose pose_at(LoadedScene& loaded, double time_s, Index animation);

/// Moves nodes, as Renderer::place() does; lays out afresh when one of them was taken to stand for ever.
/// Throws Error for a node or a place that is none.
void place_nodes(gpu::Device& device, LoadedScene& loaded, std::span<const NodePlace> places, double time_s);

/// Makes the meshes of the loaded scene as its objects' links want them, and forgets what was made of those
/// before.
void lay_out(gpu::Device& device, LoadedScene& loaded);

/// Gives the loaded scene another terrain in place of its own, and lays out afresh when that is cut into
/// other triangles. Returns whether it was. Throws Error when it does not fit, and the one before stays.
[[nodiscard]] bool swap_terrain(gpu::Device& device, LoadedScene& loaded, const Terrain& terrain);

/// Brings lights and objects to what `style` says of them, and lays out afresh when an object stands
/// otherwise to the lights than before. Returns whether shadows may fall otherwise, which they do not where
/// lights are brighter or lower. Throws Error as styled_lighting() does.
[[nodiscard]] bool style_lighting(gpu::Device& device, LoadedScene& loaded, const light::LightStyle& style);

/// How far from the eye what stands in front is; a terrain, which is everywhere, keeps it near.
[[nodiscard]] float nearby_m(const pose::MeshData& layout, const glm::dvec3& eye);

} // namespace estampe::frame
