// SPDX-License-Identifier: MIT
#pragma once

// The shadow map of the sun: what it is to be, what it holds, how it is drawn, and which of what stands
// still throws its shadow into a piece of it.

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

/// A draw that throws shadows and stands still for ever.
struct StillCaster {
    pose::Range range;
    Bounds place; ///< in the world
    bool masked = false;
    Groups groups = all_groups;
};

/// Those of a scene, in the order of their triangles. Cost: linear in nodes and triangles.
[[nodiscard]] std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene);

/// Adds what of `still` may be seen in a piece, as at most `most` batches or one for each kind: short gaps
/// between them are drawn too. Cost: linear in draws.
void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches);

/// What decides how the sun's shadow is kept.
struct SunScene {
    Bounds casters;       ///< world space
    Bounds still;         ///< those of them that stand still for ever
    double floor_m = 0.0; ///< nothing that is lit lies lower, world space
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool throws_shadow = false;
    uint64_t most_bytes = 1ULL << 27U; ///< of a buffer on the device
};

/// What the map is to be.
struct SunMapPlan {
    uint32_t size = 0; ///< texels a side; 0 for no shadow
    shadow::SunView view;
    std::optional<shadow::Clipmap> clipmap; ///< in place of a single map of the view
    shadow::Windows windows;                ///< of the clipmap
    uint32_t variant = 0;                   ///< how it is looked up, see shaders/light_variant.glsl.h
};

/// What of the map is to be drawn now.
struct SunMapWork {
    Groups groups = all_groups; ///< of those that the sun shadows
    bool redraws_whole = false;
    std::vector<shadow::Piece> pieces; ///< of a clipmap, not drawn yet
    bool draws_levels = false;         ///< these are its levels, all of them, drawn together
    /// What stands still has a map of its own, and the pieces are of that.
    bool has_still = false;
    std::vector<shadow::Piece> squares;    ///< then those of the map where something else may be seen now
    std::vector<shared::RasterView> views; ///< of them, or of the levels, which are the same where both are
    uint32_t tile_count = 0;               ///< of the squares, in which that is so
};

/// What throws shadows, as far as it decides how the map is kept.
struct SunCasters {
    uint32_t layout = 0; ///< another number where what stands still may be other triangles
    Groups groups = all_groups;
    bool by_compute = false;
    bool are_parted = false; ///< what moves is to be drawn apart from what stands still
};

/// Of a scene that was laid out as `layout_number`, whose maps are drawn by `path`.
[[nodiscard]] SunCasters sun_casters(const pose::MeshData& layout, uint32_t layout_number, Groups groups,
                                     RasterPath path);

/// Which casters count.
enum class Casters : uint8_t { all, still, moving };

/// Whether there are casters that may move, and such that never do.
struct CasterKinds {
    bool moving = false;
    bool still = false;
};

[[nodiscard]] CasterKinds caster_kinds(const pose::MeshData& layout);

/// What blocks a light that `groups` of casters shadow, as runs of triangles, in place of what `batches`
/// held.
void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches);

/// What shadow maps are drawn from, and by what.
struct ShadowScene {
    const raster::RasterInputs& raster;
    const pose::MeshData& layout;
    std::span<const StillCaster> still;                         ///< of `layout`
    std::optional<gpu::BufferId> cluster_bounds = std::nullopt; ///< needed where local maps are out of date
    RasterPath path = RasterPath::compute;                      ///< never automatic
    raster::Tuning tuning = {};
};

/// Plans the map: its view, its size, and the windows of a clipmap where the style or, by itself, a scene
/// that is far larger than what is near the eye wants one.
[[nodiscard]] SunMapPlan plan_sun_map(const SunScene& scene, const Camera& camera, glm::uvec2 size_px,
                                      const PixelSize& pixel, const StyleTables& style);

/// The map as the light's shader looks it up.
[[nodiscard]] shared::SunShadow sun_globals(const SunMapPlan& plan, const PixelSize& pixel,
                                            const shadow::ShadowStyle& style);

/// The map between pictures: what it holds, and what of it has to be drawn.
class SunMap {
public:
    /// What threw the shadow has changed.
    void forget() { view_.reset(); }

    /// What moves has moved, from and to these places (anchor space).
    void move(std::span<const Bounds> places) { moved_.insert(moved_.end(), places.begin(), places.end()); }

    /// Makes room for the map that `plan` wants, and says what to draw into it. From the second time on that
    /// something has moved under the same sun, what stands still is kept, and drawn anew by itself when the
    /// sun goes on after it has stood.
    [[nodiscard]] SunMapWork ensure(gpu::Device& device, const SunMapPlan& plan, const SunCasters& casters);
    /// That has been drawn.
    void drawn(const SunMapPlan& plan);

    /// Draws what is to be drawn of the map, and hands it on.
    ///
    /// Cost    nothing where nothing is to be drawn; else that of raster::add_depth(), of a clipmap for each
    ///         piece, of what stands still only what is seen there; of all its levels, in compute, that of
    ///         raster::add_depth_views(). Where what stands still is kept, so is what moves drawn, and mixed
    ///         in where it was and is
    [[nodiscard]] gpu::BufferId record(gpu::Graph& graph, const ShadowScene& scene, const SunMapPlan& plan,
                                       const SunMapWork& work);

    [[nodiscard]] gpu::Buffer& buffer() { return map_; }

    /// Room for what is drawn of what moves, beside which it holds whatever was drawn before.
    [[nodiscard]] gpu::Buffer& pictures() { return pictures_; }

private:
    /// Of what moves, drawn over what stands still.
    void ensure_moving(gpu::Device& device, const SunMapPlan& plan, SunMapWork& work);
    /// Draws that into `map`.
    gpu::BufferId add_moving(gpu::Graph& graph, const raster::RasterInputs& by_sun,
                             const shadow::Clipmap& clipmap, const SunMapWork& work, raster::DepthViews views,
                             gpu::BufferId still, gpu::BufferId map);

    gpu::Buffer map_;
    gpu::Buffer still_; ///< what stands still alone, where that is kept
    gpu::Buffer views_; ///< of the work
    gpu::Buffer pictures_;
    gpu::Buffer tiles_; ///< of the pictures, those in which the map changes
    std::vector<uint32_t> tile_list_;
    std::vector<raster::Batch> casters_; ///< its room serves the next frame
    bool has_still_ = false;             ///< it is up to date wherever the map is
    bool stood_ = false;                 ///< the sun, when the map was last provided
    std::vector<Bounds> moved_;
    uint32_t layout_ = 0;
    std::optional<glm::mat4> view_; ///< of what the map holds; none when it is out of date
    std::optional<shadow::Clipmap> clipmap_;
    shadow::Windows windows_;
};

} // namespace estampe::features
