// SPDX-License-Identifier: MIT
#pragma once

// Twelve places to look from.

#include <string>
#include <vector>

#include <estampe/terrain.hpp>

#include "plan.hpp"
#include "site.hpp"

namespace temple {

struct Viewpoint {
    std::string name;
    glm::vec3 eye_m{0.0F};
    glm::vec3 target_m{0.0F};
    float vertical_fov_deg = 45.0F;
};

/// From outside to the last hall; eyes stand on what is there.
[[nodiscard]] std::vector<Viewpoint> find_viewpoints(const Plan& plan, const Site& site,
                                                     const estampe::Terrain& desert);

} // namespace temple
