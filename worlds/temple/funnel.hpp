// SPDX-License-Identifier: MIT
#pragma once

// The body of a tornado: a trunk of sand that turns, sways and leans ahead.

#include <cstddef>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "weather.hpp"

namespace temple {

inline constexpr double funnel_m = 46.0; ///< high

/// Where the middle of its trunk is at a share of its height, over its foot; along x and z.
[[nodiscard]] glm::dvec2 funnel_sway_m(double share, double time_s);

/// How wide it is there, from its middle.
[[nodiscard]] double funnel_radius_m(double share);

/// How far it has turned there, clockwise from above.
[[nodiscard]] double funnel_turn_rad(double share, double time_s);

/// Adds `funnel`, its joints, and its skinned mesh, whose material comes after those that are there. It
/// stands nowhere until it is moved.
void add_funnel(estampe::Scene& scene);

/// Where its nodes are, of which `first` is `funnel`; one more than the last of them is the next free node.
[[nodiscard]] std::vector<estampe::NodePlace> funnel_places(estampe::Index first, const Tornado& tornado,
                                                            double ground_m, double time_s);

} // namespace temple
