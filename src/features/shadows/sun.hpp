// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow map: its plan, its content, how it is drawn, and which static shadow casters a piece of
// the map needs.

#include <optional>
#include <span>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/raster.hpp"
#include "techniques/raster/views/views.hpp"
#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::features {

/// A draw call that casts shadows and never moves.
struct StillCaster {
    pose::Range range;
    Bounds place; ///< Bounds of the caster in world space
    bool masked = false;
    Groups groups = all_groups;
};

/// Returns the static shadow casters of a scene, in the order of their triangles. Cost: linear in nodes and
/// triangles.
[[nodiscard]] std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene);

/// Appends the shadow casters of `still` that may be visible in a piece of the clipmap, as at most `most`
/// batches of triangles (more only if there are more kinds of casters). Batches are merged by drawing also
/// the triangles in short gaps between them. Cost: linear in draw calls.
void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches);

/// The properties of a scene that decide the size and place of its sun's shadow map.
struct SunScene {
    Bounds casters;       ///< Bounds of all shadow casters in world space
    Bounds still;         ///< Bounds of the static shadow casters in world space
    double floor_m = 0.0; ///< Lowest height in world space that the sun lights
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool throws_shadow = false;
    uint64_t most_bytes = 1ULL << 27U; ///< Largest size of a buffer on the device
};

/// Size and layout of the sun's shadow map.
struct SunMapPlan {
    uint32_t size = 0; ///< Texels per side of the shadow map; 0: no shadow
    shadow::SunView view;
    /// Clipmap (shadow map in levels around the eye); if set, it is used instead of the single map of `view`.
    std::optional<shadow::Clipmap> clipmap;
    shadow::Windows windows; ///< Windows of the clipmap's levels
    uint32_t variant = 0;    ///< Method by which shaders look up the map, see shaders/light_variant.glsl.h
};

/// The parts of the sun's shadow map that must be drawn now.
struct SunMapWork {
    Groups groups = all_groups; ///< Groups of casters that block the sun
    bool redraws_whole = false;
    std::vector<shadow::Piece> pieces; ///< Pieces of the clipmap that are not drawn yet
    bool draws_levels = false; ///< `pieces` contains all levels of the clipmap, which are drawn together
    /// Static casters have a shadow map of their own, and `pieces` belong to that map.
    bool has_still = false;
    /// Squares of the shadow map that moving casters may change; only used if `has_still`.
    std::vector<shadow::Piece> squares;
    /// Views from the sun, one for each of the squares or of the levels. If there are squares and levels,
    /// their views are equal.
    std::vector<shared::RasterView> views;
    uint32_t tile_count = 0; ///< Number of tiles in the squares that may change
};

/// The properties of shadow casters that decide how the sun's map is kept.
struct SunCasters {
    /// Number of the layout; changes when the static casters' triangles may have changed.
    uint32_t layout = 0;
    Groups groups = all_groups;
    bool by_compute = false;
    bool are_parted = false; ///< Moving casters are drawn separately from static casters
};

/// Describes the shadow casters of a scene with the layout `layout_number`, whose maps are drawn by `path`.
[[nodiscard]] SunCasters sun_casters(const pose::MeshData& layout, uint32_t layout_number, Groups groups,
                                     RasterPath path);

enum class Casters : uint8_t { all, still, moving };

/// Tells whether a scene has shadow casters that may move, and casters that never do.
struct CasterKinds {
    bool moving = false;
    bool still = false;
};

[[nodiscard]] CasterKinds caster_kinds(const pose::MeshData& layout);

/// Fills `batches` with the shadow casters of the given light groups, as runs of triangles.
void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches);

/// Geometry and rasteriser for drawing shadow maps.
struct ShadowScene {
    const raster::RasterInputs& raster;
    const pose::MeshData& layout;
    std::span<const StillCaster> still; ///< Static shadow casters of `layout`
    /// Bounding boxes of clusters of triangles; required if local maps are obsolete.
    std::optional<gpu::BufferId> cluster_bounds = std::nullopt;
    /// Path by which shadow maps are rasterised; never RasterPath::automatic.
    RasterPath path = RasterPath::compute;
    raster::Tuning tuning = {};
};

/// Plans the sun's shadow map: view, size and, for a clipmap (a map in levels around the eye), its windows. A
/// clipmap is used if the style asks for it, or by default if the scene is much larger than its part near the
/// eye.
[[nodiscard]] SunMapPlan plan_sun_map(const SunScene& scene, const Camera& camera, glm::uvec2 size_px,
                                      const PixelSize& pixel, const StyleTables& style);

/// Returns the constants with which the light shader reads the sun's shadow map.
[[nodiscard]] shared::SunShadow sun_globals(const SunMapPlan& plan, const PixelSize& pixel,
                                            const shadow::ShadowStyle& style);

/// Keeps the sun's shadow map between pictures, and decides which parts to draw.
class SunMap {
public:
    /// Makes the shadow map obsolete after a change of casters or light.
    void forget() { view_.reset(); }

    /// Records that an object moved between the boxes `places`, so that the shadow map is drawn again there.
    /// Boxes are relative to the scene's anchor (the origin of positions on the device).
    void move(std::span<const Bounds> places) { moved_.insert(moved_.end(), places.begin(), places.end()); }

    /// Allocates the shadow map for `plan`, and returns the parts of the map to draw. If an object moves
    /// while the sun is as in the previous picture, static casters get a map of their own. The map of static
    /// casters is drawn again when the sun moves after a rest.
    [[nodiscard]] SunMapWork ensure(gpu::Device& device, const SunMapPlan& plan, const SunCasters& casters);
    /// Records that the parts of the shadow map for `plan` have been drawn.
    void drawn(const SunMapPlan& plan);

    /// Draws the parts of the sun's shadow map that are listed in `work`, and returns the map.
    ///
    /// Cost    nothing if nothing must be drawn. Otherwise raster::add_depth(); for a clipmap once per piece
    ///         with the static casters of the piece, or on the compute path raster::add_depth_views() for
    ///         all levels. If static casters have a map of their own, moving casters are also drawn and
    ///         merged into the map, at their previous and current places
    [[nodiscard]] gpu::BufferId record(gpu::Graph& graph, const ShadowScene& scene, const SunMapPlan& plan,
                                       const SunMapWork& work);

    [[nodiscard]] gpu::Buffer& buffer() { return map_; }

    /// Returns the buffer with the depths of moving casters. Only tiles that were drawn are valid; other
    /// tiles hold old data.
    [[nodiscard]] gpu::Buffer& pictures() { return pictures_; }

private:
    /// Plans the views and tiles of moving shadow casters, to be merged over the static map.
    void ensure_moving(gpu::Device& device, const SunMapPlan& plan, SunMapWork& work);
    /// Draws the moving shadow casters and merges them with `still`, the map of static casters. The result is
    /// written to `map`.
    gpu::BufferId add_moving(gpu::Graph& graph, const raster::RasterInputs& by_sun,
                             const shadow::Clipmap& clipmap, const SunMapWork& work, raster::DepthViews views,
                             gpu::BufferId still, gpu::BufferId map);

    gpu::Buffer map_;
    gpu::Buffer still_; ///< Map of the static casters alone; empty if they have no separate map
    gpu::Buffer views_; ///< Views from which the parts of the map are drawn
    gpu::Buffer pictures_;
    gpu::Buffer tiles_; ///< Tiles of `pictures_` in which the map changes
    std::vector<uint32_t> tile_list_;
    std::vector<raster::Batch> casters_; ///< List of casters, kept to reuse its memory
    bool has_still_ = false;             ///< The map of static casters is valid where the whole map is valid
    bool stood_ = false;                 ///< The sun had not moved at the last call of ensure()
    std::vector<Bounds> moved_;
    uint32_t layout_ = 0;
    std::optional<glm::mat4> view_; ///< View from which the map was drawn; none if the map is obsolete
    std::optional<shadow::Clipmap> clipmap_;
    shadow::Windows windows_;
};

} // namespace estampe::features
