// SPDX-License-Identifier: MIT
#pragma once

// Lamps, braziers and the smoke of the great ones, and the daylight that falls through the roofs.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
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

/// Smoke over a brazier.
struct Plume {
    glm::vec3 foot_m{0.0F};
    int room = 0;
};

/// Two in the entrance and two in the last hall: those that are farthest from the door through which one
/// comes.
[[nodiscard]] std::vector<Plume> find_plumes(const Plan& plan, uint64_t seed);

/// Adds `smoke N`, of no size until they are placed.
void add_smoke(estampe::Scene& scene, const std::vector<Plume>& plumes);

/// Where they are, for Renderer::place(); `first` is the scene's node `smoke 0`. Those in rooms out of sight,
/// and those too far off to be more than a dot, have no size, so that nothing rises there.
[[nodiscard]] std::vector<estampe::NodePlace> smoke_places(estampe::Index first,
                                                           const std::vector<Plume>& plumes,
                                                           const glm::dvec3& eye_m,
                                                           const std::vector<bool>& in_sight);

} // namespace temple
