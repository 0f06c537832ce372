// SPDX-License-Identifier: MIT
#pragma once

// Reference values for tests of subsurface scattering.

#include <cmath>
#include <numbers>

namespace estampe::subsurface {

/// Share of Burley's profile within `x` times d of a line through its middle, on one side. The profile is
/// integrated along lines, which gives modified Bessel functions, and then across, with x = s^2.
[[nodiscard]] inline double beside_line(double x)
{
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) * std::sqrt(x) / steps;
        const double t = s * s;
        sum += (std::cyl_bessel_k(0.0, t) + std::cyl_bessel_k(0.0, t / 3.0)) * 2.0 * s;
    }
    return sum * std::sqrt(x) / steps / (4.0 * std::numbers::pi);
}

} // namespace estampe::subsurface
