// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// A stroke found in a painting: its middle, a point a pixel in the order it was drawn or the reverse.
struct PaintedStroke {
    std::vector<glm::vec2> points; ///< unit square, not wrapped
    std::vector<float> half_px;    ///< half the width at each point, in pixels of the painting
};

/// Strokes that are ink in `darker` and not in `lighter` (empty for paper), both of `size_px`.
///
/// The difference of the two is thinned to lines one pixel wide (Zhang and Suen, 1984), which are cut where
/// they cross. Ends that point at each other over a gap of ink, such as a lighter stroke, are joined again.
/// Widths are distances to the nearest paper, scaled so that the strokes have as much ink as the difference.
///
/// Lines of less than 3 px are left out, and all but the longest 20000.
[[nodiscard]] std::vector<PaintedStroke> find_strokes(const Gray8& lighter, const Gray8& darker,
                                                      uint32_t size_px);

/// Thins `mask` (0 or 1 a texel, wrapping) to lines one texel wide that keep its connections.
///
/// Source  Zhang and Suen, "A Fast Parallel Algorithm for Thinning Digital Patterns", CACM 1984
void thin(std::vector<uint8_t>& mask, uint32_t size_px);

} // namespace estampe::tam
