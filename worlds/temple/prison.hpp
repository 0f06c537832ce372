// SPDX-License-Identifier: MIT
#pragma once

// Builds the rooms of the prison in stone, following the floor plan. Also computes which rooms are visible
// from a place, by a portal search: the search follows lines of sight from room to room through doors.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "kit.hpp"
#include "plan.hpp"

namespace temple {

/// An object of the temple: one mesh and one node.
struct Thing {
    std::string name;
    Kit kit;
    glm::vec3 place_m{0.0F};
    bool on_sand = false; ///< The height of `place_m` is relative to the sand
};

/// Builds the prison's walls and piers, and for each room its floor, roof, columns and bars.
[[nodiscard]] std::vector<Thing> build_prison(const Plan& plan, uint64_t seed);

/// Returns the centre of the opening in a hall's roof through which light falls; nothing if the roof has no
/// opening.
[[nodiscard]] std::optional<glm::vec2> shaft_of(const Plan& plan, int room);

inline constexpr float shaft_half_m = 0.9F;

/// Divides a scene into the prison's rooms, for culling by cells and portals. Each room with a roof becomes a
/// cell. Doors, the holes in roofs, and slits below the roofs where stones of the outer walls are missing,
/// become portals. Rooms without a roof belong to outdoors. The seed must be that of build_prison().
void add_cells(const Plan& plan, uint64_t seed, estampe::Scene& scene);

/// Tells for each room whether any part of it may be visible from a place. The visibility test widens doors
/// by 0.8 m on either side, so that objects appear in the scene before they come into sight. Rooms without a
/// roof count as outdoors. From outside, rooms are visible through doors. From above the roofs, within 60 m,
/// rooms are also visible through the holes in their roofs. Source: Luebke and Georges, "Portals and
/// Mirrors", 1995; here in two dimensions. Cost: some microseconds.
[[nodiscard]] std::vector<bool> rooms_in_sight(const Plan& plan, const glm::vec3& eye_m);

} // namespace temple
