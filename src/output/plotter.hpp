// SPDX-License-Identifier: MIT
#pragma once

// What makes a drawing ready for a pen: strokes that are left out or cut into dashes, and an order with
// little travel.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Leaves out what runs along a stroke of the same ink before it: strokes that are there twice, and stretches
/// of strokes that lie within a third of their width of another and run its way. Strokes may fall apart.
/// Lines that cross stay whole. Cost: linear in points.
void remove_overlaps(VectorDrawing& drawing);

/// Cuts hidden strokes into dashes.
void cut_dashes(VectorDrawing& drawing);

/// Leaves out where hatching is thinner than half its usual width.
void remove_thin_hatching(VectorDrawing& drawing);

/// Where a stroke starts and ends on the page.
struct PenStroke {
    glm::vec2 start{0.0F};
    glm::vec2 end{0.0F};
};

/// One stroke of an order, and whether it is drawn from its end to its start.
struct PenStep {
    uint32_t stroke = 0;
    bool is_turned = false;
};

/// How far the pen travels in the air, from `origin` on.
[[nodiscard]] double travel_mm(std::span<const PenStroke> strokes, std::span<const PenStep> order,
                               const glm::vec2& origin);

/// An order of all strokes: always the nearest end next, then stretches of it are turned around as long as
/// that shortens the way, at most `turn_budget` comparisons.
[[nodiscard]] std::vector<PenStep> shortest_order(std::span<const PenStroke> strokes, const glm::vec2& origin,
                                                  uint64_t turn_budget);

} // namespace estampe::output
