// SPDX-License-Identifier: MIT
#include "frame/tile.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "techniques/lens/lens.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/smoke/smoke.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::frame {

Tile whole_page(glm::uvec2 page_px)
{
    const features::PixelRect all{.size_px = page_px};
    return {all, all};
}

uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm)
{
    // A pixel's own neighbours: the slope of a surface, an edge found between two.
    constexpr uint32_t neighbours_px = 4;
    return bleed::reach_px(style.bleed, pixels_per_mm) +
           std::max(hatch::reach_px(style.hatch, pixels_per_mm),
                    contour::reach_px(style.contour, pixels_per_mm)) +
           smoke::reach_px(style.smoke, pixels_per_mm) + lens::reach_px(style.lens, pixels_per_mm) +
           occlusion::reach_px(style.occlusion, pixels_per_mm) +
           subsurface::reach_px(style.subsurface, pixels_per_mm) + neighbours_px;
}

std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap)
{
    if (most_px <= 2 * overlap) {
        throw Error(
            fmt::format("tiles of {} pixels are too small for strokes that reach {} pixels beyond them",
                        most_px, overlap),
            "tiles", "draw at fewer pixels a millimetre, or in a style whose ink runs less far");
    }
    const glm::uvec2 drawn_px = glm::min(page_px, glm::uvec2(most_px));
    const auto step = [&](int axis) {
        return drawn_px[axis] < page_px[axis] ? most_px - 2 * overlap : page_px[axis];
    };
    std::vector<Tile> tiles;
    for (uint32_t y = 0; y < page_px.y; y += step(1)) {
        for (uint32_t x = 0; x < page_px.x; x += step(0)) {
            const glm::uvec2 from(x, y);
            const glm::uvec2 size = glm::min(glm::uvec2(step(0), step(1)), page_px - from);
            const glm::uvec2 drawn_from =
                glm::min(from - glm::min(from, glm::uvec2(overlap)), page_px - drawn_px);
            tiles.push_back({.drawn = {drawn_from, drawn_px}, .kept = {from, size}});
        }
    }
    return tiles;
}

features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels)
{
    const auto size_at = [&](uint32_t shrink) { return (page_px + (shrink - 1)) / shrink; };
    const auto is_small = [&](glm::uvec2 size) {
        return std::max(size.x, size.y) <= most_px && uint64_t{size.x} * size.y <= most_pixels;
    };
    uint32_t shrink = 1;
    while (!is_small(size_at(shrink))) {
        ++shrink;
    }
    return {.part = {.size_px = shrink * size_at(shrink)}, .shrink = shrink};
}

} // namespace estampe::frame
