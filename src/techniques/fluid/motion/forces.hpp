// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

struct ForceStyle {
    glm::vec3 acceleration_m_s2{0.0F}; ///< everywhere
    float friction_per_s = 0.0F;       ///< share of the speed that is lost, at first
    float lift_m_s2 = 0.0F;            ///< up y, by a unit of temperature
    float weight_m_s2 = 0.0F;          ///< down y, by a unit of density
    /// Feeds the vortices with so much of the speed that they have within a cell, each second.
    float confinement_per_s = 0.0F;
    Rim rim; ///< where what moves takes up `outside_m_s`
    glm::vec3 outside_m_s{0.0F};

    bool operator==(const ForceStyle&) const = default;
};

/// `velocity` after `time_s` of forces; itself when there are none. Without `quantities` nothing is light or
/// heavy.
[[nodiscard]] gpu::ImageId add_forces(gpu::Graph& graph, const Grid& grid, const ForceStyle& style,
                                      gpu::ImageId velocity, std::optional<gpu::ImageId> quantities,
                                      float time_s);

} // namespace estampe::fluid
