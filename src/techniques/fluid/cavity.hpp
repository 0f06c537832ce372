// SPDX-License-Identifier: MIT
#pragma once

// The lid-driven cavity: a benchmark flow with published steady states, used by tests and measurements.

#include <span>
#include <vector>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// The cavity's grid: a square of side 1 m whose upper wall (lid) moves at 1 m/s.
[[nodiscard]] Grid cavity_grid(uint32_t side_cells);

/// Differences between a simulated lid-driven cavity and the reference, and extreme speeds, in metres per
/// second.
struct CavityFit {
    double rms_u = 0.0; ///< error of the horizontal speed along the vertical centre line
    double rms_v = 0.0; ///< error of the vertical speed along the horizontal centre line
    double least_u = 0.0;
    double least_v = 0.0;
    double most_v = 0.0;
};

/// Compares a simulated cavity with the published reference. `velocity` is laid out as in FluidFields. Throws
/// std::logic_error unless `reynolds` is 100, 400 or 1000.
[[nodiscard]] CavityFit cavity_fit(const Grid& grid, std::span<const float> velocity, int reynolds);

} // namespace estampe::fluid
