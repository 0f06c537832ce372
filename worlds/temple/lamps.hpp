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

/// What burns there.
struct PlacedFlame {
    glm::vec3 place_m{0.0F}; ///< of its foot
    bool is_fire = false;    ///< of a brazier, else of a lamp
};

struct Lamps {
    std::vector<PlacedLight> lights; ///< at least 30, of which few throw shadows
    std::vector<PlacedFlame> flames; ///< one for each lamp and brazier
    Kit kit;                         ///< what they burn in
};

/// A flame, or the tongues of a brazier's fire, with its foot at the origin.
[[nodiscard]] Kit build_flame(bool is_fire);

[[nodiscard]] Lamps hang_lamps(const Plan& plan, uint64_t seed);

} // namespace temple
