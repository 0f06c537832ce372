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
    /// Numbers of nodes and materials of the scene that the caller gave. Further ones, of terrain and of
    /// cloth with two sides, follow in `scene`.
    size_t given_nodes = 0;
    size_t given_materials = 0;
    features::LightingOfScene own_lighting;    ///< lights and light links as the scene's file has them
    features::LightingOfScene styled_lighting; ///< lights and light links of `scene` with the style applied
    std::optional<features::LightingSettings>
        styled_by; ///< lighting settings of the style from which `styled_lighting` was computed
    pose::MeshData layout;
    /// Number of the current layout (vertices, triangles and draw calls): incremented each time the meshes
    /// are rebuilt.
    uint32_t layout_number = 0;
    std::vector<features::StillCaster>
        still_casters;                  ///< draw calls of `layout` that cast shadows and never move
    Bounds still_room;                  ///< bounding box of `still_casters`
    pose::MeshBuffers meshes;           ///< vertices, triangles and draw calls of `layout` on the device
    raster::ClusterBoxes cluster_boxes; ///< bounding boxes of clusters of triangles in `meshes`
    surface::MaterialBuffers materials;
    surface::SceneNeeds needs;
    std::vector<std::string> notes;           ///< warnings about the scene's textures
    std::vector<std::string> notes_of_cells;  ///< warnings about nodes that name cells and portals
    std::optional<Lightmap> lightmap;         ///< lightmap of the scene; none unless the caller gave one
    std::optional<features::WornLight> baked; ///< `lightmap` mapped to the triangles of `layout`
    std::optional<pose::PoseData> pose;       ///< pose of the vertices on the device; none after a new layout
    std::map<uint32_t, features::SurfaceMap>
        surface_maps; ///< texture atlases over all surfaces, keyed by their side in texels
    features::DefaultLight default_light;
    light::ExposureKeyCache exposure_key;
    features::PlacedNodes placed; ///< nodes that the program has placed
    /// Buffers of the terrain; null if the scene has no terrain.
    std::unique_ptr<terrain::TerrainBuffers> terrain;
    /// Footprints in the terrain's sand; null if the scene has no terrain.
    std::unique_ptr<terrain::Footprints> footprints;
    std::vector<bool> ink_zones; ///< one flag per node: its mesh is an ink zone and not in `layout`; empty if
                                 ///< there are none
    bool terrain_moved = false;  ///< the terrain's vertices on the device are out of date
    bool has_plain_links = true; ///< true if every object is lit and shadowed by all lights
    bool pose_moved = true;      ///< the posed vertices on the device are out of date
};

/// Uploads `scene`, and `lightmap` unless that is null. Throws Error when the scene does not fit the device,
/// or when the lightmap belongs to another scene.
[[nodiscard]] LoadedScene load_onto_device(gpu::Device& device, const Scene& scene, const Lightmap* lightmap);

/// Returns the pose of the scene at a time, including the nodes that the calling program has placed.
[[nodiscard]] ScenePose pose_at(LoadedScene& loaded, double time_s, Index animation);

/// Moves nodes to the places that the calling program gives. If a node that the program placed was treated as
/// static, the meshes are rebuilt. Throws Error for an invalid node or place.
void place_nodes(gpu::Device& device, LoadedScene& loaded, std::span<const NodePlace> places, double time_s);

/// Rebuilds the meshes of the loaded scene according to its objects' light links, and discards everything
/// that was derived from the old meshes.
void lay_out(gpu::Device& device, LoadedScene& loaded);

/// Replaces the terrain of the loaded scene, and rebuilds the meshes if the new terrain needs other
/// triangles. Returns whether the meshes were rebuilt. Throws Error when the new terrain does not fit the
/// device; the old terrain then stays.
[[nodiscard]] bool swap_terrain(gpu::Device& device, LoadedScene& loaded, const Terrain& terrain);

/// Applies the lighting settings of `style` to lights and objects, and rebuilds the meshes when light links
/// change. Returns whether shadows may change; a change of brightness alone never changes shadows. Throws
/// Error as styled_lighting() does.
[[nodiscard]] bool style_lighting(gpu::Device& device, LoadedScene& loaded,
                                  const features::StyleTables& style);

/// Removes the meshes of the style's ink zones from the layout, and adds the meshes of nodes that are no
/// longer ink zones. Returns whether the meshes were rebuilt. Throws Error if no mesh would be left.
[[nodiscard]] bool hide_ink_zones(gpu::Device& device, LoadedScene& loaded,
                                  const features::StyleTables& style);

/// Distance from the eye to the objects of the scene that are near it. If there is a terrain, the result is
/// always short, because the terrain surrounds the eye.
[[nodiscard]] float nearby_m(const pose::MeshData& layout, const glm::dvec3& eye);

} // namespace estampe::frame
