// SPDX-License-Identifier: MIT
#pragma once

// The fires of the temple: lamps, braziers, the smoke of the large braziers, and the daylight that falls
// through the roofs.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "plan.hpp"
#include "prison.hpp"

namespace temple {

/// A light and its position; spot lights shine straight down.
struct PlacedLight {
    estampe::Light light;
    glm::vec3 place_m{0.0F};
};

/// A flame of a lamp or a fire of a brazier.
struct PlacedFlame {
    glm::vec3 place_m{0.0F}; ///< Position of the flame's foot
    bool is_fire = false;    ///< The flame is the fire of a brazier, not of a lamp
};

struct Lamps {
    std::vector<PlacedLight> lights; ///< Lights of the temple: at least 30, of which few cast shadows
    std::vector<PlacedFlame> flames; ///< Flames of the temple, one for each lamp and brazier
    Kit kit;                         ///< Shapes of the lamps and braziers
};

/// Builds the flame of a lamp, or the fire of a brazier, with its foot at the origin.
[[nodiscard]] Kit build_flame(bool is_fire);

[[nodiscard]] Lamps hang_lamps(const Plan& plan, uint64_t seed);

/// A column of smoke over a brazier.
struct Plume {
    glm::vec3 foot_m{0.0F};
    int room = 0;
};

/// Finds the columns of smoke over two braziers in the entrance and two in the last hall: in each of the two
/// rooms, over the two braziers that are farthest from the visitor's door.
[[nodiscard]] std::vector<Plume> find_plumes(const Plan& plan, uint64_t seed);

/// Adds the nodes `smoke N` to the scene, which emit smoke. The size of the nodes is 0 until smoke_places()
/// places the nodes.
void add_smoke(estampe::Scene& scene, const std::vector<Plume>& plumes);

/// Returns the transforms of the smoke emitters, for Renderer::place(); `first` is the index of the scene's
/// node `smoke 0`. Emitters in rooms out of sight, or so far away that their smoke would be a dot, have size
/// 0 and emit no smoke.
[[nodiscard]] std::vector<estampe::NodePlace> smoke_places(estampe::Index first,
                                                           const std::vector<Plume>& plumes,
                                                           const glm::dvec3& eye_m,
                                                           const std::vector<bool>& in_sight);

} // namespace temple
