// SPDX-License-Identifier: MIT
#pragma once

// What rises from the great halls' fires.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "plan.hpp"

namespace temple {

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
