// SPDX-License-Identifier: MIT
#pragma once

// Converts the lines of hatching to paths, for vector output.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/hatch/hatch.glsl.h"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {

/// Finds the points where the lines that add_hatch() draws pass between neighbouring pixels.
///
/// Writes  the number of crossings, then a list of shared::Crossing in any order; crossings without room in
///         the list are only counted
/// Cost    two full-screen dispatches per style variant (the style of certain materials or objects); some 60
/// bytes per pixel, more if strokes are finer
///         than a pixel, at most `most_bytes`
/// Source  marching squares: Lorensen and Cline, "Marching Cubes", SIGGRAPH 1987
[[nodiscard]] gpu::BufferId add_trace(gpu::Graph& graph, const HatchInputs& in,
                                      const std::vector<HatchVariant>& variants, uint64_t most_bytes);

struct TracedPoint {
    glm::vec2 page_px{0.0F};
    float width_px = 0.0F;
};

struct TracedStroke {
    uint32_t draw = 0;
    uint32_t family = 0; ///< number of the family of parallel strokes; each layer has two families
    bool is_closed = false;
    std::vector<TracedPoint> points; ///< two or more points, about one pixel apart
};

/// Links the crossings of lines to strokes. Crossings on the border of one square of four pixels are linked.
/// The result does not depend on the order of the crossings. Cost: n log n in the number n of crossings,
/// about 1 us each.
[[nodiscard]] std::vector<TracedStroke> string_crossings(std::span<const shared::Crossing> crossings,
                                                         const glm::uvec2& size_px);

} // namespace estampe::hatch
