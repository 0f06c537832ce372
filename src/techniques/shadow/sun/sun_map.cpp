// SPDX-License-Identifier: MIT
#include "techniques/shadow/sun/sun_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "shaders/mix_levels_comp.hpp"
#include "shaders/sun_vertices_comp.hpp"
#include "shaders/tiles.glsl.h"
#include "techniques/shadow/alternatives/warp.hpp"
#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

SunView sun_view(const Bounds& casters, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                 uint32_t size)
{
    const glm::dvec3 helper = std::abs(towards_sun.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, towards_sun));
    const glm::dvec3 up = glm::cross(towards_sun, right);
    Bounds seen;
    for (int i = 0; i < 8 && !casters.empty(); ++i) {
        const glm::dvec3 corner = glm::dvec3((i & 1) != 0 ? casters.max.x : casters.min.x,
                                             (i & 2) != 0 ? casters.max.y : casters.min.y,
                                             (i & 4) != 0 ? casters.max.z : casters.min.z) -
                                  anchor;
        seen.extend({glm::dot(corner, right), glm::dot(corner, up), glm::dot(corner, towards_sun)});
    }
    if (seen.empty()) {
        seen.extend(glm::dvec3(-0.5));
        seen.extend(glm::dvec3(0.5));
    }
    // Two texels of margin keep the casters' outline inside the map. No side may have the length zero.
    const glm::dvec3 extent = glm::max(seen.max - seen.min, glm::dvec3(1e-3 * std::max(seen.radius(), 1e-6)));
    const double rim = 1.0 + 4.0 / static_cast<double>(size);
    const glm::dvec3 half = 0.5 * rim * extent;
    const glm::dvec3 center = seen.center();

    const auto row = [](const glm::dvec3& axis, double scale, double offset) {
        return glm::dvec4(axis * scale, offset * scale);
    };
    const glm::dvec4 x = row(right, 1.0 / half.x, -center.x);
    const glm::dvec4 y = row(up, -1.0 / half.y, -center.y);
    glm::dvec4 z = row(towards_sun, 0.5 / half.z, -center.z);
    z.w += 0.5;
    SunView view;
    view.clip_from_anchor = glm::mat4(glm::transpose(glm::dmat4(x, y, z, glm::dvec4(0, 0, 0, 1))));
    view.right = glm::vec3(right);
    view.down = glm::vec3(-up);
    view.extent_m = glm::vec2(2.0 * half);
    view.texel_m = static_cast<float>(2.0 * std::max(half.x, half.y) / static_cast<double>(size));
    view.depth_m = static_cast<float>(2.0 * half.z);
    return view;
}

shared::SunShadow sun_shadow(const SunView& view, uint32_t size, const ShadowStyle& style)
{
    return {.clip_from_anchor = view.clip_from_anchor,
            .right = view.right,
            .texel_m = view.texel_m,
            .down = view.down,
            .depth_m = view.depth_m,
            .texels_per_m = static_cast<float>(size) / view.extent_m,
            .size = size,
            .sun_slope = std::tan(glm::radians(style.sun_radius_deg)),
            .warp = view.warp};
}

namespace {

// Side of a clipmap level's window divided by the step by which the window moves.
constexpr uint32_t steps_a_window = 16;

double texel_m(const Clipmap& clipmap, uint32_t level)
{
    return std::ldexp(clipmap.finest_m, static_cast<int>(level));
}

/// The strip of texels that a clipmap level must draw after its window has moved by `by` to `low`. The
/// strip's width is a power of two.
Piece strip(uint32_t level, glm::ivec2 low, uint32_t size, int axis, int by)
{
    const uint32_t breadth = std::min(std::bit_ceil(static_cast<uint32_t>(std::abs(by))), size);
    Piece piece{.level = level, .low = low, .size = glm::uvec2(size)};
    piece.size[axis] = breadth;
    piece.low[axis] += by > 0 ? static_cast<int>(size - breadth) : 0;
    return piece;
}

/// Range of a clipmap level's texels in which a box is seen, with two texels of margin; may be infinite.
std::pair<glm::dvec2, glm::dvec2> span_of(const Clipmap& clipmap, uint32_t level, const Bounds& place)
{
    constexpr double beside_texels = 2.0;
    const std::array axes{glm::dvec3(clipmap.view.right), glm::dvec3(clipmap.view.down)};
    glm::dvec2 low(0.0);
    glm::dvec2 high(0.0);
    for (int axis = 0; axis < 2; ++axis) {
        for (int k = 0; k < 3; ++k) {
            const double along = axes.at(static_cast<size_t>(axis))[k] / texel_m(clipmap, level);
            if (along != 0.0) { // avoids the product of infinity and zero
                low[axis] += std::min(along * place.min[k], along * place.max[k]);
                high[axis] += std::max(along * place.min[k], along * place.max[k]);
            }
        }
    }
    return {low - beside_texels, high + beside_texels};
}

/// The square of a clipmap level's window that contains the texels from `low` to `high`.
Piece square_in(const Clipmap& clipmap, uint32_t level, const glm::ivec2& window, glm::ivec2 low,
                const glm::ivec2& high)
{
    low.x &= ~3;
    const glm::uvec2 extent(high - low);
    const uint32_t side = std::clamp(std::bit_ceil(std::max(extent.x, extent.y)), 64U, clipmap.size);
    const glm::ivec2 last = window + static_cast<int>(clipmap.size - side);
    return {.level = level, .low = glm::min(low, last), .size = glm::uvec2(side)};
}

/// Texel of a clipmap level at which the picture of a square starts. The picture wraps around at the square's
/// size.
glm::ivec2 picture_low(const Clipmap& clipmap, const Piece& square)
{
    return square.size.x == clipmap.size ? glm::ivec2(0) : square.low;
}

/// Marks tiles of a square's picture, one bit per tile.
class TileMarks {
public:
    TileMarks(const Clipmap& clipmap, const Piece& square)
        : low_(square.low), end_(square.low + glm::ivec2(square.size)),
          picture_low_(picture_low(clipmap, square)), last_(static_cast<int>(square.size.x) / side - 1)
    {
    }

    /// Marks the tiles that contain texels of the clipmap level from `first` to before `end`.
    void mark(const glm::ivec2& first, const glm::ivec2& end)
    {
        const glm::ivec2 low = glm::max(first, low_);
        const glm::ivec2 high = glm::min(end, end_) - 1;
        if (glm::any(glm::greaterThan(low, high))) {
            return;
        }
        const glm::ivec2 from = tile_of(low);
        const glm::ivec2 to = tile_of(high);
        uint64_t columns = 0;
        for (int x = from.x; x <= to.x; ++x) {
            columns |= uint64_t{1} << static_cast<uint32_t>(x & last_);
        }
        for (int y = from.y; y <= to.y; ++y) {
            rows_.at(static_cast<size_t>(y & last_)) |= columns;
        }
    }

    void list(uint32_t square, std::vector<uint32_t>& tiles) const
    {
        for (uint32_t y = 0; y < rows_.size(); ++y) {
            for (uint64_t left = rows_.at(y); left != 0; left &= left - 1) {
                tiles.push_back(square << 16U | y << 8U | static_cast<uint32_t>(std::countr_zero(left)));
            }
        }
    }

private:
    static constexpr auto side = static_cast<int>(shared::square_tile_texels);

    /// Tile that contains a texel, before wrapping around the picture's size.
    [[nodiscard]] glm::ivec2 tile_of(const glm::ivec2& texel) const
    {
        return glm::ivec2(glm::floor(glm::dvec2(texel - picture_low_) / static_cast<double>(side)));
    }

    glm::ivec2 low_;
    glm::ivec2 end_;
    glm::ivec2 picture_low_;
    int last_;                        ///< number of the last tile of a row
    std::array<uint64_t, 64> rows_{}; ///< rows of one bit per tile, large enough for the largest level
};

} // namespace

Clipmap fit_clipmap(const SunView& view, uint32_t size, double finest_m, double radius_m)
{
    Clipmap clipmap{.view = view, .size = size};
    // Least number of texels that a clipmap level's window covers on each side of the eye.
    const double covered_texels = static_cast<double>(size) * (0.5 - 1.0 / steps_a_window) - 2.0;
    const double coarsest_m = std::max(2.0 * radius_m / covered_texels, 1e-9);
    int finest = static_cast<int>(std::floor(std::log2(std::max(finest_m, 1e-9))));
    const int coarsest = std::max(static_cast<int>(std::ceil(std::log2(coarsest_m))), finest);
    finest = std::max(finest, coarsest + 1 - static_cast<int>(most_levels));
    clipmap.finest_m = std::ldexp(1.0, finest);
    clipmap.level_count = static_cast<uint32_t>(coarsest + 1 - finest);
    return clipmap;
}

Windows windows_about(const Clipmap& clipmap, const glm::dvec3& eye_anchor)
{
    const double step = static_cast<double>(clipmap.size) / steps_a_window;
    // If the eye is far from all casters, the windows surround the point of the casters' box that is nearest
    // to the eye.
    const glm::dvec2 half_m = 0.5 * glm::dvec2(clipmap.view.extent_m);
    const glm::dvec2 middle_m = -half_m * glm::dvec2(clipmap.view.clip_from_anchor[3]);
    const glm::dvec2 eye = glm::clamp(glm::dvec2(glm::dot(eye_anchor, glm::dvec3(clipmap.view.right)),
                                                 glm::dot(eye_anchor, glm::dvec3(clipmap.view.down))),
                                      middle_m - half_m, middle_m + half_m);
    Windows windows;
    for (uint32_t level = 0; level < clipmap.level_count; ++level) {
        const glm::dvec2 low = eye / texel_m(clipmap, level) - 0.5 * static_cast<double>(clipmap.size);
        windows.emplace_back(glm::ivec2(glm::floor(low / step + 0.5) * step));
    }
    return windows;
}

std::vector<Piece> uncovered(const Clipmap& clipmap, const Windows& before, const Windows& now)
{
    const auto size = static_cast<int>(clipmap.size);
    std::vector<Piece> pieces;
    for (uint32_t level = 0; level < now.size(); ++level) {
        const glm::ivec2 low = now[level];
        const glm::ivec2 by = before.empty() ? glm::ivec2(size) : low - before[level];
        if (std::max(std::abs(by.x), std::abs(by.y)) >= size) {
            pieces.push_back({.level = level, .low = low, .size = glm::uvec2(clipmap.size)});
            continue;
        }
        for (int axis = 0; axis < 2; ++axis) {
            if (by[axis] != 0) {
                pieces.push_back(strip(level, low, clipmap.size, axis, by[axis]));
            }
        }
    }
    return pieces;
}

std::vector<Piece> squares_about(const Clipmap& clipmap, const Windows& windows,
                                 std::span<const Bounds> places, std::span<const Piece> pieces)
{
    std::vector<Piece> squares;
    for (uint32_t level = 0; level < windows.size(); ++level) {
        const glm::dvec2 first(windows[level]);
        const glm::dvec2 end = first + static_cast<double>(clipmap.size);
        if (std::ranges::any_of(pieces, [&](const Piece& piece) { return piece.level == level; })) {
            squares.push_back({.level = level, .low = windows[level], .size = glm::uvec2(clipmap.size)});
            continue;
        }
        glm::dvec2 low = end;
        glm::dvec2 high = first;
        for (const Bounds& place : places) {
            const auto [from, to] = span_of(clipmap, level, place);
            if (glm::all(glm::lessThan(from, end)) && glm::all(glm::greaterThan(to, first))) {
                low = glm::min(low, glm::max(from, first));
                high = glm::max(high, glm::min(to, end));
            }
        }
        if (glm::all(glm::lessThan(low, high))) {
            squares.push_back(square_in(clipmap, level, windows[level], glm::ivec2(glm::floor(low)),
                                        glm::ivec2(glm::ceil(high))));
        }
    }
    return squares;
}

void list_tiles(const Clipmap& clipmap, std::span<const Piece> squares, std::span<const Bounds> places,
                std::span<const Piece> pieces, std::vector<uint32_t>& tiles)
{
    tiles.clear();
    for (uint32_t i = 0; i < squares.size(); ++i) {
        const Piece& square = squares[i];
        const glm::dvec2 first(square.low);
        const glm::dvec2 end = first + glm::dvec2(square.size);
        TileMarks marks(clipmap, square);
        for (const Bounds& place : places) {
            const auto [low, high] = span_of(clipmap, square.level, place);
            marks.mark(glm::ivec2(glm::floor(glm::clamp(low, first, end))),
                       glm::ivec2(glm::ceil(glm::clamp(high, first, end))));
        }
        for (const Piece& piece : pieces) {
            if (piece.level == square.level) {
                marks.mark(piece.low, piece.low + glm::ivec2(piece.size));
            }
        }
        marks.list(i, tiles);
    }
}

std::vector<PieceHome> homes(const Clipmap& clipmap, const Piece& piece)
{
    // A clipmap level wraps around like a torus. The bit mask of its size, a power of two, also handles
    // negative coordinates.
    const glm::uvec2 first = glm::uvec2(piece.low) & (clipmap.size - 1U);
    const glm::uvec2 until_rim = glm::min(piece.size, clipmap.size - first);
    std::vector<PieceHome> parts;
    for (uint32_t y = 0; y < piece.size.y; y += y == 0 ? until_rim.y : piece.size.y) {
        for (uint32_t x = 0; x < piece.size.x; x += x == 0 ? until_rim.x : piece.size.x) {
            const glm::uvec2 from(x, y);
            const glm::uvec2 at = (first + from) & (clipmap.size - 1U);
            const glm::uvec2 size(x == 0 ? until_rim.x : piece.size.x - x,
                                  y == 0 ? until_rim.y : piece.size.y - y);
            parts.push_back({.from = from,
                             .size = size,
                             .texel = (piece.level * clipmap.size + at.y) * clipmap.size + at.x});
        }
    }
    return parts;
}

glm::mat4 clip_from_sun(const Piece& piece)
{
    // Powers of two and whole texels keep floats exact, so the drawn texels do not depend on the piece (the
    // rectangle of texels to draw).
    const double scale = std::ldexp(1.0, -static_cast<int>(piece.level));
    glm::dmat4 clip(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        clip[axis][axis] = 2.0 * scale / piece.size[axis];
        clip[3][axis] = -2.0 * piece.low[axis] / piece.size[axis] - 1.0;
    }
    return glm::mat4(clip);
}

shared::SunShadow sun_shadow(const Clipmap& clipmap, const Windows& windows, float pixel_m,
                             const ShadowStyle& style)
{
    shared::SunShadow shadow = sun_shadow(clipmap.view, clipmap.size, style);
    shadow.texel_m = static_cast<float>(clipmap.finest_m);
    shadow.texels_per_m = glm::vec2(static_cast<float>(1.0 / clipmap.finest_m));
    shadow.level_count = clipmap.level_count;
    shadow.pixel_m = pixel_m;
    shadow.fade = style.sun_map == SunMapKind::faded ? 1.0F : 0.0F;
    for (size_t level = 0; level < windows.size(); ++level) {
        shadow.window_low[level] = glm::vec2(windows[level]);
    }
    return shadow;
}

namespace {

/// A clipmap replaces the single shadow map if texels of the single map are larger near the eye than the
/// given number of pixels.
constexpr double coarse_texel_px = 48.0;

/// Side of a clipmap level in texels: a power of two such that `levels` of them fit into `most_bytes`.
uint32_t level_size(uint32_t wanted, uint32_t levels, uint64_t most_bytes)
{
    uint32_t size = std::clamp(std::bit_ceil(wanted), 64U, 4096U);
    while (size > 64U && 4ULL * size * size * levels > most_bytes) {
        size /= 2;
    }
    return size;
}

} // namespace

SunMapFit fit_sun_map(const SunMapScene& scene, const ShadowStyle& style)
{
    SunMapFit fit{.view = sun_view(scene.casters, scene.anchor, scene.towards_sun, scene.size),
                  .clipmap = std::nullopt,
                  .size = scene.size};
    const bool is_coarse = static_cast<double>(fit.view.texel_m) >= coarse_texel_px * scene.pixel_m;
    if (style.sun_map == SunMapKind::whole || (style.sun_map == SunMapKind::automatic && !is_coarse)) {
        return fit;
    }
    if (style.sun_map == SunMapKind::warped) {
        fit.view = warped_view(scene);
        fit.variant = fit.view.warp.y > 0.0F ? shared::light_has_sun_warp : 0U;
        return fit;
    }
    fit.view = sun_view(scene.still_box, scene.anchor, scene.towards_sun, scene.size);
    fit.clipmap = style.sun_map == SunMapKind::faded
                      ? faded_map(fit.view, level_size(scene.size, 1, scene.most_bytes), style.faded_reach_m)
                      : fit_clipmap(fit.view, level_size(2 * scene.size, most_levels, scene.most_bytes),
                                    scene.pixel_m, scene.casters.radius());
    fit.size = fit.clipmap->size;
    fit.variant = shared::light_has_sun_levels;
    return fit;
}

gpu::BufferId add_mixed_levels(gpu::Graph& graph, const Clipmap& clipmap, const MixInputs& in,
                               gpu::BufferId map)
{
    std::array<shared::MixedSquare, most_levels> constants{};
    uint32_t first_texel = 0;
    for (size_t i = 0; i < in.squares.size(); ++i) {
        const uint32_t side = in.squares[i].size.x;
        constants.at(i) = {.low = glm::uvec2(picture_low(clipmap, in.squares[i])),
                           .sizes = static_cast<uint32_t>(std::countr_zero(side)) |
                                    static_cast<uint32_t>(std::countr_zero(clipmap.size)) << 8U |
                                    in.squares[i].level << 16U,
                           .first_texel = first_texel};
        first_texel += side * side;
    }
    auto pass = graph.compute("shadow/mix", shaders::mix_levels_comp);
    pass.read(in.pictures).read(in.still).read(in.tiles);
    map = pass.modify(map);
    pass.push(constants).dispatch(in.tile_count);
    return map;
}

gpu::BufferId add_sun_vertices(gpu::Graph& graph, gpu::BufferId posed_vertices, uint32_t vertex_count,
                               const Clipmap& clipmap)
{
    auto pass = graph.compute("shadow/vertices", shaders::sun_vertices_comp);
    pass.read(posed_vertices);
    const auto vertices =
        pass.write(graph.buffer("sun vertices", {.size_bytes = 16ULL * std::max(vertex_count, 1U)}));
    const auto texels_per_m = static_cast<float>(1.0 / clipmap.finest_m);
    const glm::mat4 rows = glm::transpose(clipmap.view.clip_from_anchor);
    pass.push(shared::SunVerticesConstants{.right = clipmap.view.right * texels_per_m,
                                           .vertex_count = vertex_count,
                                           .down = clipmap.view.down * texels_per_m,
                                           .depth_row = rows[2]})
        .dispatch_items(vertex_count);
    return vertices;
}

} // namespace estampe::shadow
