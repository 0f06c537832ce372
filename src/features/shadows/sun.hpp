// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow map: its plan, its content, how it is drawn, and which static casters a piece of it
// needs.

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
    Bounds place; ///< world space
    bool masked = false;
    Groups groups = all_groups;
};

/// The static casters of a scene, in the order of their triangles. Cost: linear in nodes and triangles.
[[nodiscard]] std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene);

/// Appends the casters of `still` that may be visible in a piece of the clipmap, as at most `most` batches,
/// or more if there are more kinds of casters. To merge batches, the triangles in short gaps between them are
/// drawn too. Cost: linear in draw calls.
void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches);

/// The facts of a scene that decide how its sun map is laid out.
struct SunScene {
    Bounds casters;       ///< world space
    Bounds still;         ///< of the static casters, world space
    double floor_m = 0.0; ///< lowest lit height, world space
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool throws_shadow = false;
    uint64_t most_bytes = 1ULL << 27U; ///< limit of a buffer on the device
};

/// The layout of the sun's shadow map.
struct SunMapPlan {
    uint32_t size = 0; ///< texels per side; 0 means no shadow
    shadow::SunView view;
    std::optional<shadow::Clipmap> clipmap; ///< replaces the single map of `view`
    shadow::Windows windows;                ///< of the clipmap
    uint32_t variant = 0;                   ///< kind of lookup, see shaders/light_variant.glsl.h
};

/// The parts of the sun's map to draw now.
struct SunMapWork {
    Groups groups = all_groups; ///< caster groups that the sun uses
    bool redraws_whole = false;
    std::vector<shadow::Piece> pieces; ///< pieces of the clipmap that are not drawn yet
    bool draws_levels = false;         ///< `pieces` are all levels, drawn together
    /// Static casters have a map of their own, and `pieces` belong to it.
    bool has_still = false;
    std::vector<shadow::Piece> squares; ///< with has_still: squares of the map that moving casters may change
    std::vector<shared::RasterView> views; ///< of the squares, or of the levels; equal if there are both
    uint32_t tile_count = 0;               ///< number of tiles in the squares that may change
};

/// The facts about shadow casters that decide how the sun's map is kept.
struct SunCasters {
    uint32_t layout = 0; ///< changes when the static casters' triangles may have changed
    Groups groups = all_groups;
    bool by_compute = false;
    bool are_parted = false; ///< moving casters are drawn apart from static ones
};

/// Describes a scene with the layout `layout_number`, whose maps are drawn by `path`.
[[nodiscard]] SunCasters sun_casters(const pose::MeshData& layout, uint32_t layout_number, Groups groups,
                                     RasterPath path);

enum class Casters : uint8_t { all, still, moving };

/// Whether a scene has casters that may move, and casters that never do.
struct CasterKinds {
    bool moving = false;
    bool still = false;
};

[[nodiscard]] CasterKinds caster_kinds(const pose::MeshData& layout);

/// Replaces `batches` by the casters of these groups, as runs of triangles.
void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches);

/// Geometry and rasteriser for drawing shadow maps.
struct ShadowScene {
    const raster::RasterInputs& raster;
    const pose::MeshData& layout;
    std::span<const StillCaster> still;                         ///< static casters of `layout`
    std::optional<gpu::BufferId> cluster_bounds = std::nullopt; ///< required if local maps are obsolete
    RasterPath path = RasterPath::compute;                      ///< never automatic
    raster::Tuning tuning = {};
};

/// Plans the sun's map: view, size and, for a clipmap, its windows. A clipmap is used if the style asks for
/// it, or by default if the scene is much larger than its part near the eye.
[[nodiscard]] SunMapPlan plan_sun_map(const SunScene& scene, const Camera& camera, glm::uvec2 size_px,
                                      const PixelSize& pixel, const StyleTables& style);

/// The globals of the map for the light shader.
[[nodiscard]] shared::SunShadow sun_globals(const SunMapPlan& plan, const PixelSize& pixel,
                                            const shadow::ShadowStyle& style);

/// Keeps the sun's map between pictures, and decides which parts to draw.
class SunMap {
public:
    /// Makes the map obsolete after a change of casters or light.
    void forget() { view_.reset(); }

    /// Records that something moved from and to these boxes (anchor space).
    void move(std::span<const Bounds> places) { moved_.insert(moved_.end(), places.begin(), places.end()); }

    /// Allocates the map for `plan`, and returns the parts of the map to draw. If something moves while the
    /// sun is as in the previous picture, static casters get a map of their own. That map is drawn again when
    /// the sun moves after a rest.
    [[nodiscard]] SunMapWork ensure(gpu::Device& device, const SunMapPlan& plan, const SunCasters& casters);
    /// Records that the work for `plan` has been drawn.
    void drawn(const SunMapPlan& plan);

    /// Draws the parts listed in `work`, and returns the map.
    ///
    /// Cost    nothing if nothing must be drawn. Otherwise raster::add_depth(), for a clipmap once per piece
    ///         with only the static casters of the piece, or in compute raster::add_depth_views() for all
    ///         levels. With a map of static casters, moving casters are drawn and merged, too, at their
    ///         previous and current places
    [[nodiscard]] gpu::BufferId record(gpu::Graph& graph, const ShadowScene& scene, const SunMapPlan& plan,
                                       const SunMapWork& work);

    [[nodiscard]] gpu::Buffer& buffer() { return map_; }

    /// Depths of moving casters in the tiles drawn; other tiles hold old data.
    [[nodiscard]] gpu::Buffer& pictures() { return pictures_; }

private:
    /// Plans the views and tiles of moving casters, to be merged over the static map.
    void ensure_moving(gpu::Device& device, const SunMapPlan& plan, SunMapWork& work);
    /// Draws the moving casters, and merges them with `still` into `map`.
    gpu::BufferId add_moving(gpu::Graph& graph, const raster::RasterInputs& by_sun,
                             const shadow::Clipmap& clipmap, const SunMapWork& work, raster::DepthViews views,
                             gpu::BufferId still, gpu::BufferId map);

    gpu::Buffer map_;
    gpu::Buffer still_; ///< map of static casters alone, if they are kept apart
    gpu::Buffer views_; ///< views of the work
    gpu::Buffer pictures_;
    gpu::Buffer tiles_; ///< tiles of `pictures_` in which the map changes
    std::vector<uint32_t> tile_list_;
    std::vector<raster::Batch> casters_; ///< kept to reuse its memory
    bool has_still_ = false;             ///< the static map is valid wherever the map is
    bool stood_ = false;                 ///< the sun was unchanged at the last ensure()
    std::vector<Bounds> moved_;
    uint32_t layout_ = 0;
    std::optional<glm::mat4> view_; ///< view of the map's content; none if the map is obsolete
    std::optional<shadow::Clipmap> clipmap_;
    shadow::Windows windows_;
};

} // namespace estampe::features
