// SPDX-License-Identifier: MIT
#pragma once

// The strokes of a map that somebody has painted: found, and drawn again in coarser levels.

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

/// Gives a map the levels that it lacks below those that were painted, of which every tone has as many.
///
/// The strokes of a tone are found in its difference from the tone before (see find_strokes()). Each
/// coarser level drops some of the strokes of the finer one, keeping those that are best spaced, and draws
/// the rest as many pixels wide as they were painted, until the ink is the darkness of the tone.
///
/// Cost    a second or two for 512 px and 6 tones
void derive_levels(TonalArtMap& map);

/// Thins `mask` (0 or 1 a texel, wrapping) to lines one texel wide that keep its connections.
///
/// Source  Zhang and Suen, "A Fast Parallel Algorithm for Thinning Digital Patterns", CACM 1984
void thin(std::vector<uint8_t>& mask, uint32_t size_px);

} // namespace estampe::tam
