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

/// All device resources of one scene, and the scene itself without its images.
struct LoadedScene {
    Scene scene;
    features::LightingOfScene own_lighting;    ///< lights and light links as the file has them
    features::LightingOfScene styled_lighting; ///< lights and light links of `scene` with the style applied
    std::optional<features::LightingSettings>
        styled_by; ///< the style's lighting settings that produced `styled_lighting`
    pose::MeshData layout;
    uint32_t layout_number = 0; ///< incremented each time the meshes are laid out
    std::vector<features::StillCaster>
        still_casters;                  ///< triangles of `layout` that never move and cast shadows
    Bounds still_room;                  ///< bounding box of `still_casters`
    pose::MeshBuffers meshes;           ///< `layout` on the device
    raster::ClusterBoxes cluster_boxes; ///< bounding boxes of clusters of triangles in `meshes`
    surface::MaterialBuffers materials;
    surface::SceneNeeds needs;
    std::vector<std::string> notes;           ///< warnings about textures
    std::optional<Lightmap> lightmap;         ///< none unless the caller gave one
    std::optional<features::WornLight> baked; ///< `lightmap` mapped to the triangles of `layout`
    std::optional<pose::PoseData> pose;       ///< the pose that the device holds; none after a new layout
    std::map<uint32_t, features::SurfaceMap>
        surface_maps; ///< maps that styles ask for, keyed by their side in texels
    features::DefaultLight default_light;
    light::ExposureKeyCache exposure_key;
    features::PlacedNodes placed;                     ///< nodes that the program has placed
    std::unique_ptr<terrain::TerrainBuffers> terrain; ///< null where the scene has no terrain
    std::unique_ptr<terrain::Footprints> footprints;  ///< null where the scene has no terrain
    bool terrain_moved = false;  ///< the terrain's vertices on the device are out of date
    bool has_plain_links = true; ///< every object is lit and shadowed by all lights
    bool pose_moved = true;      ///< the posed vertices on the device are out of date
};

/// Uploads `scene`, and `lightmap` unless that is null. Throws Error when the scene does not fit the device,
/// or when the lightmap belongs to another scene.
[[nodiscard]] LoadedScene load_onto_device(gpu::Device& device, const Scene& scene, const Lightmap* lightmap);

/// The pose of the scene at a time, including the nodes that the program has placed.
[[nodiscard]] ScenePose pose_at(LoadedScene& loaded, double time_s, Index animation);

/// Moves nodes, as Renderer::place() does. Lays the scene out again when one of them was treated as static.
/// Throws Error for an invalid node or place.
void place_nodes(gpu::Device& device, LoadedScene& loaded, std::span<const NodePlace> places, double time_s);

/// Rebuilds the meshes of the loaded scene according to its objects' light links, and discards everything
/// that was derived from the old meshes.
void lay_out(gpu::Device& device, LoadedScene& loaded);

/// Replaces the terrain of the loaded scene, and lays the scene out again when the new one is divided into
/// other triangles. Returns whether it was laid out again. Throws Error when the terrain does not fit, and
/// keeps the old one.
[[nodiscard]] bool swap_terrain(gpu::Device& device, LoadedScene& loaded, const Terrain& terrain);

/// Applies the lighting settings of `style` to lights and objects, and lays the scene out again when light
/// links change. Returns whether shadows may change; a change of brightness alone never changes shadows.
/// Throws Error as styled_lighting() does.
[[nodiscard]] bool style_lighting(gpu::Device& device, LoadedScene& loaded,
                                  const features::StyleTables& style);

/// Distance from the eye to the nearby objects of the scene. A terrain surrounds the eye, so it limits the
/// result to a short distance.
[[nodiscard]] float nearby_m(const pose::MeshData& layout, const glm::dvec3& eye);

} // namespace estampe::frame
