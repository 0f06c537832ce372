// SPDX-License-Identifier: MIT
#include "features/shadows/sun.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "gpu/resources.hpp"
#include "shaders/light_variant.glsl.h"
#include "shaders/tiles.glsl.h"
#include "techniques/raster/views/views.hpp"

namespace estampe::features {
namespace {

/// World bounds of a draw call in the rest pose; empty if unknown.
Bounds place_of(const pose::MeshData& layout, const Scene& scene, const ScenePose& rest, uint32_t draw)
{
    const pose::DrawSource& source = layout.sources[draw];
    const auto& instances = scene.nodes[source.node].instances;
    glm::dmat4 place = rest.world_from_node[source.node];
    if (!instances.empty()) {
        place = place * glm::dmat4(instances[source.instance]);
    }
    Bounds bounds;
    const Bounds& local = source.local_bounds;
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        bounds.extend(glm::dvec3(place * glm::dvec4(corner, 1.0)));
    }
    return bounds;
}

/// Returns whether a box overlaps or adjoins a piece of the clipmap (shadow map in levels around the eye), in
/// the sun's projection.
bool is_within(const Bounds& place, const glm::dvec3& anchor, const shadow::Clipmap& clipmap,
               const shadow::Piece& piece)
{
    constexpr double beside_texels = 2.0;
    const double texel_m = std::ldexp(clipmap.finest_m, static_cast<int>(piece.level));
    const glm::dvec3 middle = 0.5 * (place.min + place.max) - anchor;
    const glm::dvec3 half = 0.5 * (place.max - place.min);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec3 along(axis == 0 ? clipmap.view.right : clipmap.view.down);
        const double at = glm::dot(along, middle) / texel_m;
        const double reach = glm::dot(glm::abs(along), half) / texel_m + beside_texels;
        const double low = piece.low[axis];
        if (at + reach < low || at - reach > low + static_cast<double>(piece.size[axis])) {
            return false;
        }
    }
    return true;
}

} // namespace

std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene)
{
    const ScenePose rest = pose_scene(scene, 0.0); // Static nodes have the same pose at any time
    std::vector<StillCaster> casters;
    for (const pose::CasterRun& run : layout.casters) {
        const uint32_t end = run.range.first + run.range.count;
        for (uint32_t triangle = run.range.first; triangle < end && !run.moves;) {
            const uint32_t draw = layout.triangles[triangle].w & shared::triangle_draw_mask;
            StillCaster caster{.range = {.first = triangle, .plain = run.range.plain},
                               .place = place_of(layout, scene, rest, draw),
                               .masked = run.masked,
                               .groups = run.groups};
            while (triangle < end && (layout.triangles[triangle].w & shared::triangle_draw_mask) == draw) {
                ++triangle;
            }
            caster.range.count = triangle - caster.range.first;
            casters.push_back(caster);
        }
    }
    return casters;
}

void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches)
{
    const size_t first = batches.size();
    // One value per batch of triangles: true if triangles that must not be drawn lie before it, so that the
    // batch cannot be merged with the batch before.
    std::vector<bool> bars;
    // Number of triangles since the last batch whose casters lie outside the piece.
    uint32_t passed_triangles = 0;
    for (const StillCaster& caster : still) {
        if (!caster.place.empty() && !is_within(caster.place, anchor, clipmap, piece)) {
            passed_triangles += caster.range.count;
            continue;
        }
        if ((caster.groups & groups) == 0) {
            continue;
        }
        const bool goes_on =
            batches.size() > first && batches.back().masked == caster.masked &&
            batches.back().groups == caster.groups &&
            batches.back().first_triangle + batches.back().triangle_count == caster.range.first;
        if (goes_on) {
            batches.back().triangle_count += caster.range.count;
            batches.back().plain = batches.back().plain && caster.range.plain;
        } else {
            const uint32_t end =
                bars.empty() ? 0 : batches.back().first_triangle + batches.back().triangle_count;
            bars.push_back(caster.range.first - end != passed_triangles);
            batches.push_back({.first_triangle = caster.range.first,
                               .triangle_count = caster.range.count,
                               .masked = caster.masked,
                               .plain = caster.range.plain,
                               .groups = caster.groups});
        }
        passed_triangles = 0;
    }
    const auto gap_before = [&](size_t i) {
        const raster::Batch& before = batches[i - 1];
        const bool is_one_kind =
            before.masked == batches[i].masked && before.groups == batches[i].groups && !bars[i - first];
        return is_one_kind ? batches[i].first_triangle - before.first_triangle - before.triangle_count : ~0U;
    };
    while (batches.size() > first + most) {
        size_t shortest = first + 1;
        for (size_t i = first + 2; i < batches.size(); ++i) {
            shortest = gap_before(i) < gap_before(shortest) ? i : shortest;
        }
        if (gap_before(shortest) == ~0U) {
            return;
        }
        batches[shortest - 1].triangle_count += gap_before(shortest) + batches[shortest].triangle_count;
        batches[shortest - 1].plain = batches[shortest - 1].plain && batches[shortest].plain;
        batches.erase(batches.begin() + static_cast<std::ptrdiff_t>(shortest));
        bars.erase(bars.begin() + static_cast<std::ptrdiff_t>(shortest - first));
    }
}

namespace {

uint32_t whole_size(const StyleTables& style, glm::uvec2 size_px)
{
    return style.light.shadow_size > 0
               ? static_cast<uint32_t>(style.light.shadow_size)
               : std::clamp(std::bit_ceil(std::max(size_px.x, size_px.y)), 512U, 4096U);
}

/// Approximate distance from the eye to the nearest shadow caster: the horizontal distance, or the height
/// above the lowest caster.
double nearest_m(const Bounds& casters, const glm::dvec3& eye)
{
    const double beside = glm::distance(glm::clamp(eye, casters.min, casters.max), eye);
    const double above = std::max(eye.y - casters.min.y, 0.0);
    return std::clamp(std::max(beside, above), 1e-3 * casters.radius(), 2.0 * casters.radius());
}

/// Returns the shadow casters' box, rounded to a coarse lattice and extended around the static casters.
/// Motion within the box changes neither the box nor the layout of the shadow map, and motion beyond the box
/// changes them seldom.
Bounds roomy(const SunScene& scene)
{
    const Bounds& middle = scene.still.empty() ? scene.casters : scene.still;
    const double pitch_m = std::exp2(std::floor(std::log2(std::max(middle.radius(), 1e-6))) - 2.0);
    const double about_m = scene.still.empty() ? 0.0 : 0.5 * pitch_m;
    return {.min = glm::floor(glm::min(scene.casters.min, middle.min - about_m) / pitch_m) * pitch_m,
            .max = glm::ceil(glm::max(scene.casters.max, middle.max + about_m) / pitch_m) * pitch_m};
}

/// Returns one view per square of the shadow map, for raster::add_depth_views(). If a square is a whole
/// level, its texels are shifted cyclically to the level's own layout.
std::vector<shared::RasterView> views_of(std::span<const shadow::Piece> squares,
                                         const shadow::Clipmap& clipmap, Groups groups)
{
    std::vector<shared::RasterView> views;
    uint32_t first_texel = 0;
    for (const shadow::Piece& square : squares) {
        views.push_back({.clip_from_anchor = shadow::clip_from_sun(square),
                         .eye_anchor = glm::vec3(0.0F),
                         .reach_m = std::numeric_limits<float>::infinity(),
                         .first_texel = first_texel,
                         .size_px = square.size.x,
                         .origin_px = glm::uvec2(0),
                         .groups = groups,
                         .turn_px = glm::uvec2(square.low) & (square.size - 1U) &
                                    (square.size.x == clipmap.size ? ~0U : 0U)});
        first_texel += square.size.x * square.size.x;
    }
    raster::place_views(views);
    return views;
}

uint64_t texels_of(std::span<const shared::RasterView> views)
{
    return views.empty() ? 4
                         : views.back().first_texel + uint64_t{views.back().size_px} * views.back().size_px;
}

} // namespace

SunMapPlan plan_sun_map(const SunScene& scene, const Camera& camera, glm::uvec2 size_px,
                        const PixelSize& pixel, const StyleTables& style)
{
    const uint32_t size = scene.throws_shadow ? whole_size(style, size_px) : 0U;
    if (!scene.throws_shadow || scene.casters.empty()) {
        return {.size = size,
                .view = shadow::sun_view(scene.casters, scene.anchor, scene.towards_sun, std::max(size, 4U))};
    }
    const double from_eye_m = nearest_m(scene.casters, camera.eye);
    const shadow::SunMapFit fit =
        shadow::fit_sun_map({.casters = scene.casters,
                             .still_box = roomy(scene),
                             .anchor = scene.anchor,
                             .towards_sun = scene.towards_sun,
                             .floor_m = scene.floor_m,
                             .nearest_m = from_eye_m,
                             .pixel_m = pixel.at(from_eye_m),
                             .most_bytes = scene.most_bytes,
                             .size = size,
                             .eye = frame_globals(camera, scene.casters, scene.anchor, {.size_px = size_px})},
                            style.shadow);
    SunMapPlan plan{.size = fit.size, .view = fit.view, .clipmap = fit.clipmap, .variant = fit.variant};
    if (plan.clipmap) {
        plan.windows = shadow::windows_about(*plan.clipmap, camera.eye - scene.anchor);
    }
    return plan;
}

shared::SunShadow sun_globals(const SunMapPlan& plan, const PixelSize& pixel,
                              const shadow::ShadowStyle& style)
{
    return plan.clipmap ? shadow::sun_shadow(*plan.clipmap, plan.windows, pixel.at_one_m, style)
                        : shadow::sun_shadow(plan.view, plan.size, style);
}

SunMapWork SunMap::ensure(gpu::Device& device, const SunMapPlan& plan, const SunCasters& casters)
{
    const uint64_t levels = plan.clipmap ? plan.clipmap->level_count : 1;
    const uint64_t size_bytes = std::max<uint64_t>(sizeof(float) * plan.size * plan.size * levels, 16);
    if (map_.empty() || map_.size_bytes() != size_bytes) {
        map_ = gpu::Buffer(device, "shadow map", size_bytes, gpu::MemoryUse::device);
        view_.reset();
    }
    if (clipmap_ != plan.clipmap || layout_ != casters.layout) {
        view_.reset();
    }
    layout_ = casters.layout;
    const bool stands = plan.size > 0 && view_ == plan.view.clip_from_anchor;
    // If the sun moves in every picture, static casters get no separate map, because such a map would never
    // be reused.
    const bool had_still = has_still_ && (stands || stood_);
    stood_ = stands;
    has_still_ = plan.clipmap && casters.are_parted && (had_still || (stands && !moved_.empty()));
    SunMapWork work{.groups = casters.groups,
                    .redraws_whole = plan.size > 0 && !has_still_ && (!stands || !moved_.empty())};
    if (plan.clipmap) {
        const bool starts = has_still_ ? !had_still || !stands : work.redraws_whole;
        work.pieces = shadow::uncovered(*plan.clipmap, starts ? shadow::Windows() : windows_, plan.windows);
        work.draws_levels = starts && casters.by_compute;
    }
    if (work.draws_levels) {
        work.views = views_of(work.pieces, *plan.clipmap, casters.groups);
    }
    if (has_still_) {
        if (still_.empty() || still_.size_bytes() != size_bytes) {
            still_ = gpu::Buffer(device, "shadow map of what stands", size_bytes, gpu::MemoryUse::device);
        }
        work.has_still = true;
        ensure_moving(device, plan, work);
    }
    if (!work.views.empty()) {
        gpu::upload_items(device, "sun views", work.views, views_);
    }
    return work;
}

void SunMap::ensure_moving(gpu::Device& device, const SunMapPlan& plan, SunMapWork& work)
{
    const shadow::Clipmap& clipmap = *plan.clipmap;
    work.squares = shadow::squares_about(clipmap, plan.windows, moved_, work.pieces);
    work.views = views_of(work.squares, clipmap, work.groups);
    const uint64_t pictures_bytes = sizeof(float) * texels_of(work.views);
    if (pictures_.empty() || pictures_.size_bytes() < pictures_bytes) {
        pictures_ = gpu::Buffer(device, "shadows of what moves", pictures_bytes, gpu::MemoryUse::device);
    }
    shadow::list_tiles(clipmap, work.squares, moved_, work.pieces, tile_list_);
    work.tile_count = static_cast<uint32_t>(tile_list_.size());
    // The buffer has room for all tiles, because the number of tiles that are used changes in every frame.
    const uint64_t side_tiles = clipmap.size / shared::square_tile_texels;
    const uint64_t tiles_bytes = sizeof(uint32_t) * clipmap.level_count * side_tiles * side_tiles;
    if (tiles_.empty() || tiles_.size_bytes() != tiles_bytes) {
        tiles_ = gpu::Buffer(device, "tiles that change", tiles_bytes, gpu::MemoryUse::upload);
    }
    std::ranges::copy(std::as_bytes(std::span(tile_list_)), tiles_.mapped().begin());
}

void SunMap::drawn(const SunMapPlan& plan)
{
    if (plan.size > 0) {
        view_ = plan.view.clip_from_anchor;
        clipmap_ = plan.clipmap;
        windows_ = plan.windows;
    }
    moved_.clear();
}

namespace {

bool counts(const pose::CasterRun& run, Casters which)
{
    return which == Casters::all || run.moves == (which == Casters::moving);
}

/// The inputs for drawing pieces of the sun's clipmap.
struct PieceDrawing {
    const ShadowScene& scene;
    raster::RasterInputs by_sun;
    std::span<const raster::Batch> casters; ///< Moving shadow casters, as runs of triangles
    const shadow::Clipmap& clipmap;
    const SunMapWork& work;

    [[nodiscard]] std::vector<raster::Batch> casters_of(const shadow::Piece& piece) const
    {
        // Limits the number of batches of triangles. A batch costs several dispatches on a GPU, but almost
        // nothing on a CPU.
        const size_t most = scene.path == RasterPath::compute ? 6 : 24;
        std::vector<raster::Batch> batches;
        if (!work.has_still) {
            batches.assign(casters.begin(), casters.end());
        }
        add_casters_within(piece, clipmap, scene.layout.anchor, scene.still, work.groups, most, batches);
        return batches;
    }

    gpu::BufferId add(gpu::Graph& graph, raster::View view, gpu::BufferId map) const
    {
        for (const shadow::Piece& piece : work.pieces) {
            view.clip_from_anchor = shadow::clip_from_sun(piece);
            view.size_px = piece.size;
            std::vector<raster::DepthPart> parts;
            for (const shadow::PieceHome& home : shadow::homes(clipmap, piece)) {
                parts.push_back({.from_px = home.from, .size_px = home.size, .first_texel = home.texel});
            }
            map = raster::add_depth_parts(graph, "shadow", by_sun, casters_of(piece), view, parts,
                                          clipmap.size, map);
        }
        return map;
    }
};

} // namespace

SunCasters sun_casters(const pose::MeshData& layout, uint32_t layout_number, Groups groups, RasterPath path)
{
    // Depths of the hardware rasteriser differ in their last bits between views. If static casters had a
    // separate layer, a continued film would then differ from an uninterrupted film.
    const CasterKinds kinds = caster_kinds(layout);
    const bool by_compute = path == RasterPath::compute;
    return {.layout = layout_number,
            .groups = groups,
            .by_compute = by_compute,
            .are_parted = by_compute && kinds.moving && kinds.still};
}

CasterKinds caster_kinds(const pose::MeshData& layout)
{
    const auto& runs = layout.casters;
    return {.moving = std::ranges::any_of(runs, [](const auto& run) { return run.moves; }),
            .still = std::ranges::any_of(runs, [](const auto& run) { return !run.moves; })};
}

void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches)
{
    batches.clear();
    for (const pose::CasterRun& run : layout.casters) {
        if ((run.groups & groups) != 0 && counts(run, which)) {
            batches.push_back({.first_triangle = run.range.first,
                               .triangle_count = run.range.count,
                               .masked = run.masked,
                               .plain = run.range.plain,
                               .groups = run.groups});
        }
    }
}

gpu::BufferId SunMap::record(gpu::Graph& graph, const ShadowScene& scene, const SunMapPlan& plan,
                             const SunMapWork& work)
{
    const gpu::BufferId map = gpu::import_whole(graph, "shadow", map_);
    // The blank ground receives shadows but does not cast any.
    list_casters(scene.layout, work.groups, plan.clipmap ? Casters::moving : Casters::all, casters_);
    const raster::View view{.clip_from_anchor = plan.view.clip_from_anchor,
                            .size_px = glm::uvec2(plan.size),
                            .cull_back_faces = false,
                            .path = scene.path,
                            .tuning = scene.tuning};
    if (!plan.clipmap) {
        return work.redraws_whole ? raster::add_depth(graph, "shadow", scene.raster, casters_, view, map)
                                  : map;
    }
    if (work.pieces.empty() && work.squares.empty()) {
        return map;
    }
    PieceDrawing drawing{
        .scene = scene, .by_sun = scene.raster, .casters = casters_, .clipmap = *plan.clipmap, .work = work};
    drawing.by_sun.posed_vertices =
        shadow::add_sun_vertices(graph, scene.raster.posed_vertices,
                                 static_cast<uint32_t>(scene.layout.draw_of_vertex.size()), *plan.clipmap);
    gpu::BufferId drawn = work.has_still ? gpu::import_whole(graph, "shadow of what stands", still_) : map;
    if (work.views.empty()) {
        drawn = drawing.add(graph, view, drawn);
        return work.has_still ? map : drawn;
    }
    const auto triangle_count = static_cast<uint32_t>(scene.layout.triangles.size());
    raster::DepthViews views{
        .list = work.views,
        .records = gpu::import_whole(graph, "sun views", views_),
        .bounds = raster::add_cluster_bounds(
            graph, drawing.by_sun, triangle_count,
            graph.buffer("sun cluster bounds", {.size_bytes = raster::cluster_bounds_bytes(triangle_count)}),
            scene.tuning),
        .path = scene.path,
        .tuning = scene.tuning};
    // Draws all levels of the clipmap as views in one pass, which saves preparing, batching and copying each
    // level. The last piece is the coarsest level; its window contains the windows of all other levels.
    drawn = work.draws_levels ? raster::add_depth_views(graph, "shadow", drawing.by_sun,
                                                        drawing.casters_of(work.pieces.back()), views, drawn)
                              : drawing.add(graph, view, drawn);
    return work.has_still ? add_moving(graph, drawing.by_sun, *plan.clipmap, work, views, drawn, map) : drawn;
}

gpu::BufferId SunMap::add_moving(gpu::Graph& graph, const raster::RasterInputs& by_sun,
                                 const shadow::Clipmap& clipmap, const SunMapWork& work,
                                 raster::DepthViews views, gpu::BufferId still, gpu::BufferId map)
{
    const gpu::BufferId tiles = gpu::import_whole(graph, "tiles that change", tiles_);
    views.tiles = raster::ViewTiles{.list = tiles, .count = work.tile_count};
    const gpu::BufferId pictures =
        raster::add_depth_views(graph, "shadow/moving", by_sun, casters_, views,
                                gpu::import_whole(graph, "shadow of what moves", pictures_));
    return shadow::add_mixed_levels(graph, clipmap,
                                    {.squares = work.squares,
                                     .pictures = pictures,
                                     .still = still,
                                     .tiles = tiles,
                                     .tile_count = work.tile_count},
                                    map);
}

} // namespace estampe::features
