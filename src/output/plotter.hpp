// SPDX-License-Identifier: MIT
#pragma once

// Prepares drawings for pen plotters: removes strokes that need not be drawn, cuts hidden strokes into
// dashes, and orders strokes so that the lifted pen travels little.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Removes strokes and parts of strokes that repeat an earlier stroke of the same ink. A part of a stroke
/// repeats an earlier stroke if it runs in the direction of the earlier stroke, at a distance of less than a
/// third of its width. If only a part of a stroke is removed, the stroke is split. Crossing strokes stay
/// complete. Cost: linear in points.
void remove_overlaps(VectorDrawing& drawing);

/// Cuts hidden strokes into dashes.
void cut_dashes(VectorDrawing& drawing);

/// Removes the parts of hatching that are thinner than half its usual width.
void remove_thin_hatching(VectorDrawing& drawing);

/// Start and end of a stroke on the page.
struct PenStroke {
    glm::vec2 start{0.0F};
    glm::vec2 end{0.0F};
};

/// One step of a plotting order: which stroke is drawn, and whether it is drawn in reverse.
struct PenStep {
    uint32_t stroke = 0;
    bool is_turned = false;
};

/// Distance that the pen travels while lifted, starting at `origin`.
[[nodiscard]] double travel_mm(std::span<const PenStroke> strokes, std::span<const PenStep> order,
                               const glm::vec2& origin);

/// Orders all strokes for a short pen travel. First, the stroke with the nearest end always comes next.
/// Afterwards the method 2-opt reverses parts of the order while a reversal shortens the pen's travel, with
/// at most `turn_budget` comparisons.
[[nodiscard]] std::vector<PenStep> shortest_order(std::span<const PenStroke> strokes, const glm::vec2& origin,
                                                  uint64_t turn_budget);

} // namespace estampe::output
