// SPDX-License-Identifier: MIT
#pragma once

// What of the prison can be seen from a place: rooms are cells, and doors the portals between them.

#include <vector>

#include <glm/glm.hpp>

#include "plan.hpp"

namespace temple {

/// For each room whether anything in it may be seen from that place; doors count as 0.8 m wider to either
/// side than they are, so that what comes into sight is there before it does. Rooms that have lost their roof
/// are as the open air. From outside, rooms are seen through doors and, from above the roofs, from 60 m
/// around through the holes in them. After Luebke and Georges, "Portals and Mirrors", 1995, in the plane.
/// Cost: some microseconds.
[[nodiscard]] std::vector<bool> rooms_in_sight(const Plan& plan, const glm::vec3& eye_m);

} // namespace temple
