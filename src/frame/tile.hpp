// SPDX-License-Identifier: MIT
#pragma once

// A page that is drawn in parts. All plans are of the whole page; a tile is a window into it, by the same
// camera: the projection cropped, and the place of the tile's first pixel on the page.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"

namespace estampe::frame {

struct Tile {
    features::PixelRect drawn; ///< what is kept, and as much around it as its pixels hang on
    features::PixelRect kept;  ///< all tiles of a page together: the page, each pixel once
};

/// The page as one tile.
[[nodiscard]] Tile whole_page(glm::uvec2 page_px);

/// How far off the page the pixels may lie that one of this style hangs on, beside what is found for the
/// whole page: as far as ink runs and strokes run over, and half a line that is found between pixels.
[[nodiscard]] uint32_t overlap_px(const features::StyleTables& style, float pixels_per_mm);

/// Tiles row by row from the upper left, none drawn larger than `most_px` a side. All are drawn at one size,
/// those at the right and the bottom with more around them, so that what is made for one serves the next.
/// Throws Error when the overlap leaves nothing of a tile.
[[nodiscard]] std::vector<Tile> tiles_of(glm::uvec2 page_px, uint32_t most_px, uint32_t overlap);

/// As fine as one of up to `most_pixels`, and of no side longer than `most_px`, can be.
[[nodiscard]] features::Survey survey_of(glm::uvec2 page_px, uint32_t most_px, uint64_t most_pixels);

} // namespace estampe::frame
