// SPDX-License-Identifier: MIT
#pragma once

// The rooms of a plan in stone, and what of them can be seen from a place: rooms are cells, and doors the
// portals between them.

#include <string>
#include <vector>

#include <glm/glm.hpp>

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

/// For each room whether anything in it may be seen from that place; doors count as 0.8 m wider to either
/// side than they are, so that what comes into sight is there before it does. Rooms that have lost their roof
/// are as the open air. From outside, rooms are seen through doors and, from above the roofs, from 60 m
/// around through the holes in them. After Luebke and Georges, "Portals and Mirrors", 1995, in the plane.
/// Cost: some microseconds.
[[nodiscard]] std::vector<bool> rooms_in_sight(const Plan& plan, const glm::vec3& eye_m);

} // namespace temple
