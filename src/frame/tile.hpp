// SPDX-License-Identifier: MIT
#pragma once

// A page that is drawn in parts. All plans are of the whole page; a tile is a window into it, by the same
// camera: the projection cropped, and the place of the tile's first pixel on the page.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "shaders/shared.hpp"

namespace estampe::frame {

struct StyleTables;

/// A rectangle of pixels of the page.
struct PixelRect {
    glm::uvec2 from_px{0};
    glm::uvec2 size_px{0};
    bool operator==(const PixelRect&) const = default;
};

struct Tile {
    PixelRect drawn; ///< what is kept, and as much around it as its pixels hang on
    PixelRect kept;  ///< all tiles of a page together: the page, each pixel once
};

/// The page as one tile.
[[nodiscard]] Tile whole_page(glm::uvec2 page_px);

/// How far off the page the pixels may lie that one of this style hangs on, beside what is found for the
/// whole page: as far as ink runs and strokes run over, and half a line that is found between pixels.
[[nodiscard]] uint32_t overlap_px(const StyleTables& style, float pixels_per_mm);

/// Tiles row by row from the upper left, none drawn larger than `most_px` a side. All are drawn at one size,
/// those at the right and the bottom with more around them, so that what is made for one serves the next.
/// Throws Error when the overlap leaves nothing of a tile.
[[nodiscard]] std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap);

/// A whole page in fewer pixels, in which is found what must not hang on tiles.
struct Survey {
    PixelRect part;      ///< in pixels of the page; a little more than that where the size does not divide
    uint32_t shrink = 1; ///< pixels of the page to one of the survey

    [[nodiscard]] glm::uvec2 size_px() const { return part.size_px / shrink; }
};

/// As fine as one of up to `most_pixels`, and of no side longer than `most_px`, can be.
[[nodiscard]] Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels);

/// From clip space of the page to that of a part of it: on the page y points down in both.
[[nodiscard]] glm::dmat4 crop_of(const PixelRect& part, glm::uvec2 page_px);

} // namespace estampe::frame
