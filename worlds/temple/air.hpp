// SPDX-License-Identifier: MIT
#pragma once

// What the wind carries: sand over the ground and in storms, and tornadoes. Nodes that give particles, moved
// along with the eye and with the weather.

#include <functional>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "weather.hpp"

namespace temple {

/// Adds `sand N`, `whirl N` and `murk N`, which give particles, and `eddy N`, which turns ink; all of
/// no size until they are moved; and the funnel of a tornado.
void add_air(estampe::Scene& scene);

/// Who is in it.
struct AirView {
    glm::dvec3 eye_m{0.0};
    double time_s = 0.0;
    std::function<float(const glm::vec2&)> ground_m;
    std::function<bool(const glm::vec2&)> is_roofed; ///< no sand rises there
};

/// Where they are in a weather, for Renderer::place(); `first` is the scene's node `sand 0`. Those that give
/// nothing have no size.
[[nodiscard]] std::vector<estampe::NodePlace> air_places(estampe::Index first, const Weather& weather,
                                                         const AirView& view);

} // namespace temple
