// SPDX-License-Identifier: MIT
#pragma once

// Lamps, braziers, and the daylight that falls through the roofs.

#include <vector>

#include <estampe/scene.hpp>

#include "plan.hpp"
#include "prison.hpp"

namespace temple {

/// A light and where it hangs; spots shine straight down.
struct PlacedLight {
    estampe::Light light;
    glm::vec3 place_m{0.0F};
};

struct Lamps {
    std::vector<PlacedLight> lights; ///< at least 30, of which few throw shadows
    Kit kit;                         ///< what they burn in
};

[[nodiscard]] Lamps hang_lamps(const Plan& plan, uint64_t seed);

} // namespace temple
