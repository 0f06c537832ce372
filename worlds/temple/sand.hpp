// SPDX-License-Identifier: MIT
#pragma once

// The desert, and the sand that has drifted against the walls and in through the gaps.

#include <estampe/terrain.hpp>

#include "plan.hpp"

namespace temple {

/// Where the sand lies around the temple, and under its floors. The wind blows from the east.
[[nodiscard]] float sand_level_m(const Plan& plan, uint64_t seed, const glm::vec2& place_m);

/// Dunes that go with the wind, and among them, still, the temple's own sand.
[[nodiscard]] estampe::Terrain make_desert(const Plan& plan, uint64_t seed);

} // namespace temple
