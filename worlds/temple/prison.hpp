// SPDX-License-Identifier: MIT
#pragma once

// The rooms of a plan in stone.

#include <string>
#include <vector>

#include "kit.hpp"
#include "plan.hpp"

namespace temple {

/// A thing of the scene: one mesh, one node.
struct Thing {
    std::string name;
    Kit kit;
    glm::vec3 place_m{0.0F};
    bool on_sand = false; ///< its place is so high over the sand
};

/// Walls, piers, and for each room its floor, roof, columns and bars.
[[nodiscard]] std::vector<Thing> build_prison(const Plan& plan, uint64_t seed);

/// The opening in a hall's roof through which light falls, if it has one: its middle.
[[nodiscard]] std::optional<glm::vec2> shaft_of(const Plan& plan, int room);

inline constexpr float shaft_half_m = 0.9F;

} // namespace temple
