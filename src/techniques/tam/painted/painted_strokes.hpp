// SPDX-License-Identifier: MIT
#pragma once

// Finds the strokes of a painted tonal art map, and draws these strokes again in coarser levels.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// A stroke that was found in a painting: its centre line with one point per pixel, in drawing order or
/// reversed.
struct PaintedStroke {
    std::vector<glm::vec2> points; ///< points of the centre line in the unit square; positions do not wrap
    std::vector<float> half_px;    ///< half the stroke's width at each point, in pixels of the painting
};

/// Finds the strokes that are ink in `darker` but not in `lighter`. Both images have `size_px` texels per
/// side; an empty `lighter` means paper.
///
/// The difference is thinned to lines one pixel wide (Zhang and Suen, 1984), which are cut where they cross.
/// Line ends that point at each other across older ink (for example, a stroke of the lighter tone) are joined
/// again. Widths are distances to the nearest paper, scaled so that the strokes have as much ink as the
/// difference.
///
/// Drops lines shorter than 3 px, and all but the longest 20000.
[[nodiscard]] std::vector<PaintedStroke> find_strokes(const Gray8& lighter, const Gray8& darker,
                                                      uint32_t size_px);

/// Adds the coarse levels that a painted map lacks. Every tone must have the same number of painted levels.
///
/// The strokes of a tone are found in the tone's difference from the previous tone (see find_strokes()). Each
/// coarser level keeps the best spaced strokes of the next finer level. The kept strokes are drawn as many
/// pixels wide as they were painted, until the ink equals the darkness of the tone.
///
/// Cost    a second or two for 512 px and 6 tones
void derive_levels(TonalArtMap& map);

/// Thins the ink of `mask` (0 or 1 per texel, wrapping) to lines one texel wide. Connections are preserved.
///
/// Source  Zhang and Suen, "A Fast Parallel Algorithm for Thinning Digital Patterns", CACM 1984
void thin(std::vector<uint8_t>& mask, uint32_t size_px);

} // namespace estampe::tam
