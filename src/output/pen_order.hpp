// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::output {

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
