// SPDX-License-Identifier: MIT
#pragma once

// The strokes of lines as paths.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/hatch/hatch.glsl.h"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {

/// Finds where the lines that add_hatch() draws pass between neighbouring pixels.
///
/// Writes  how many crossings there are, then shared::Crossing as far as they have room, in no order
/// Cost    two full-screen dispatches for each look; some 60 bytes a pixel, more where strokes are finer than
/// a pixel, and at
///         most `most_bytes`
/// Source  marching squares: Lorensen and Cline, "Marching Cubes", SIGGRAPH 1987
[[nodiscard]] gpu::BufferId add_trace(gpu::Graph& graph, const HatchInputs& in,
                                      const std::vector<LookHatch>& looks, uint64_t most_bytes);

struct TracedPoint {
    glm::vec2 page_px{0.0F};
    float width_px = 0.0F;
};

struct TracedStroke {
    uint32_t draw = 0;
    uint32_t family = 0; ///< two a layer
    bool is_closed = false;
    std::vector<TracedPoint> points; ///< two or more, about a pixel apart
};

/// Strings crossings together, square by square of four pixels. The same crossings in any order give the same
/// strokes, in the same order. Cost: n log n in crossings, about 1 us each.
[[nodiscard]] std::vector<TracedStroke> string_crossings(std::span<const shared::Crossing> crossings,
                                                         const glm::uvec2& size_px);

} // namespace estampe::hatch
