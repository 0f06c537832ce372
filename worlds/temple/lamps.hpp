// SPDX-License-Identifier: MIT
#pragma once

// Lamps, braziers, the smoke of the large braziers, and the daylight that falls through the roofs.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "plan.hpp"
#include "prison.hpp"

namespace temple {

/// A light and its position; spots shine straight down.
struct PlacedLight {
    estampe::Light light;
    glm::vec3 place_m{0.0F};
};

/// A flame of a lamp or a fire of a brazier.
struct PlacedFlame {
    glm::vec3 place_m{0.0F}; ///< position of its foot
    bool is_fire = false;    ///< it belongs to a brazier, not to a lamp
};

struct Lamps {
    std::vector<PlacedLight> lights; ///< at least 30, of which few cast shadows
    std::vector<PlacedFlame> flames; ///< one for each lamp and brazier
    Kit kit;                         ///< the bodies of lamps and braziers
};

/// Builds a flame, or the tongues of a brazier's fire, with its foot at the origin.
[[nodiscard]] Kit build_flame(bool is_fire);

[[nodiscard]] Lamps hang_lamps(const Plan& plan, uint64_t seed);

/// The smoke over a brazier.
struct Plume {
    glm::vec3 foot_m{0.0F};
    int room = 0;
};

/// The plumes over two braziers in the entrance and two in the last hall: in each room, those farthest from
/// the door through which a visitor comes.
[[nodiscard]] std::vector<Plume> find_plumes(const Plan& plan, uint64_t seed);

/// Adds the emitters `smoke N`, which have no size until they are placed.
void add_smoke(estampe::Scene& scene, const std::vector<Plume>& plumes);

/// Transforms of the emitters, for Renderer::place(); `first` is the scene's node `smoke 0`. Emitters in
/// rooms out of sight, and those too far away to be more than a dot, have no size, so that they emit no
/// smoke.
[[nodiscard]] std::vector<estampe::NodePlace> smoke_places(estampe::Index first,
                                                           const std::vector<Plume>& plumes,
                                                           const glm::dvec3& eye_m,
                                                           const std::vector<bool>& in_sight);

} // namespace temple
