// SPDX-License-Identifier: MIT
#pragma once

// A sudden expansion of hot air, as things outside of the simulated air see it.

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace estampe::features {

/// A ball of hot air that expands. The ball holds heat, its temperature times its volume; so while its
/// temperature T falls from T0 to X, its volume grows by the factor T0 / T. The excess of T over X decays
/// exponentially, as in the fluid's simulation (fluid::add_swelling()).
struct Blast {
    glm::dvec3 centre{0.0};  ///< centre of the ball in the world
    double at_s = 0.0;       ///< time at which the expansion starts
    double start_m3 = 0.0;   ///< volume of the ball before it expands
    double growth = 1.0;     ///< factor by which the volume grows in the end, at least 1
    double rate_per_s = 0.0; ///< rate at which the excess of temperature decays

    /// Volume of the ball; `start_m3` before the blast.
    [[nodiscard]] double volume_m3(double time_s) const
    {
        if (time_s <= at_s) {
            return start_m3;
        }
        const double last = 1.0 / growth;
        return start_m3 / (last + (1.0 - last) * std::exp(-rate_per_s * (time_s - at_s)));
    }

    /// Radius of the ball, to the third power.
    [[nodiscard]] double cubed_radius_m3(double time_s) const
    {
        return 0.75 / std::numbers::pi * volume_m3(time_s);
    }

    /// Returns where air, and what drifts with it, is at `to_s` if it is at `place` at `from_s` and only the
    /// blast moves it. Outside of the ball, as much volume passes through each sphere about the centre as the
    /// ball gains: r^3 grows as the ball's radius to the third power does. Inside, the air spreads evenly.
    [[nodiscard]] glm::dvec3 pushed(const glm::dvec3& place, double from_s, double to_s) const
    {
        const double from_m3 = cubed_radius_m3(from_s);
        const double to_m3 = cubed_radius_m3(to_s);
        if (to_m3 == from_m3 || !(from_m3 > 0.0)) {
            return place;
        }
        const glm::dvec3 away = place - centre;
        const double cubed_m3 = std::pow(glm::length(away), 3.0);
        const double grown = cubed_m3 > from_m3 ? (cubed_m3 + to_m3 - from_m3) / cubed_m3 : to_m3 / from_m3;
        return centre + std::cbrt(grown) * away;
    }
};

} // namespace estampe::features
