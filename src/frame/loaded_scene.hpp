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
#include "features/lighting/default_light.hpp"
#include "features/lighting/light_links.hpp"
#include "features/lighting/lightmaps.hpp"
#include "features/shadows/sun_casters.hpp"
#include "techniques/light/light.hpp"
#include "techniques/motion_blur/smear.hpp"
#include "techniques/motion_blur/stretch.hpp"
#include "techniques/occlusion/discs/disc_map.hpp"
#include "techniques/pose/pose.hpp"
#include "techniques/raster/clusters/clusters.hpp"
#include "techniques/surface/materials.hpp"
#include "techniques/terrain/terrain_buffers.hpp"
#include "techniques/terrain/trails/footprints.hpp"

namespace estampe::frame {

/// Everything of one scene that lives on the device, and the scene itself without its pictures.
struct LoadedScene {
    Scene scene;
    features::LightingOfScene own_lighting;    ///< as the file has it
    features::LightingOfScene styled_lighting; ///< as `scene` has it now
    std::optional<features::LightingWords>
        styled_by; ///< what made that of the file's, unless that has changed since
    pose::MeshData layout;
    uint32_t layout_number = 0;                       ///< of how many this is the last
    std::vector<features::StillCaster> still_casters; ///< of that
    Bounds still_room;                                ///< about all of them
    pose::MeshBuffers meshes;
    raster::ClusterBoxes cluster_boxes; ///< of these
    surface::MaterialBuffers materials;
    surface::SceneNeeds needs;
    std::vector<std::string> notes;                        ///< what became of textures
    std::optional<Lightmap> lightmap;                      ///< where one was given
    std::optional<features::WornLight> baked;              ///< the same as the meshes wear it
    std::optional<pose::PoseData> pose;                    ///< what the device holds now
    occlusion::DiscBuffers discs;                          ///< made when a style first asks for them
    occlusion::DiscMapBuffers disc_map;                    ///< then, where they are summed in a map
    std::map<uint32_t, features::SurfaceMap> surface_maps; ///< that styles ask for, by their side in texels
    motion_blur::CoincidentVertices together;              ///< then, too
    motion_blur::SmearSeeds smear_seeds;                   ///< and these
    features::DefaultLight default_light;
    light::ExposureKeyCache exposure_key;
    features::PlacedNodes placed;                     ///< what a program moves
    std::unique_ptr<terrain::TerrainBuffers> terrain; ///< where the scene has one
    std::unique_ptr<terrain::Footprints> trodden;     ///< then
    bool terrain_moved = false;                       ///< the device has yet to pose its vertices
    bool has_plain_links = true;                      ///< every object stands to all lights alike
    bool pose_moved = true;                           ///< the device has yet to pose its vertices by it
};

/// Uploads `scene`, with a lightmap unless that is null. Throws Error when it does not fit the device, or
/// when the lightmap is another scene's.
[[nodiscard]] LoadedScene load_onto_device(gpu::Device& device, const Scene& scene, const Lightmap* lightmap);

/// The scene at a moment, what a program moves among it.
[[nodiscard]] ScenePose pose_at(LoadedScene& loaded, double time_s, Index animation);

/// Moves nodes, as Renderer::place() does; lays out afresh when one of them was taken to stand for ever.
/// Throws Error for a node or a place that is none.
void place_nodes(gpu::Device& device, LoadedScene& loaded, std::span<const NodePlace> places, double time_s);

/// What was found of another pose, or other ground, is lost, whether the next picture looks at it or not.
void forget_other_poses(LoadedScene& loaded);

/// The discs of all that is neither blank ground nor terrain, in the colours of their vertices and materials.
/// Cost: n log n in vertices.
[[nodiscard]] occlusion::DiscBuffers discs_of(gpu::Device& device, const LoadedScene& loaded);

/// Where smear strokes may begin: on all that is solid, and neither blank ground nor terrain.
/// Cost: linear in triangles.
[[nodiscard]] motion_blur::SmearSeeds smear_seeds_of(gpu::Device& device, const pose::MeshData& layout);

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
