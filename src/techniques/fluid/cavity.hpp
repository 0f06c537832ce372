// SPDX-License-Identifier: MIT
#pragma once

// The lid-driven cavity, whose steady flows are known: what tests and measurements compare with.

#include <span>
#include <vector>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// A square of side 1 m whose lid moves at 1 m/s.
[[nodiscard]] Grid cavity_grid(uint32_t side_cells);

/// How a flow in it compares. Speeds in metres a second.
struct CavityFit {
    double rms_u = 0.0; ///< to the reference along the vertical through the middle
    double rms_v = 0.0; ///< along the horizontal
    double least_u = 0.0;
    double least_v = 0.0;
    double most_v = 0.0;
};

/// `velocity` in layers of faces, as FluidFields has it. `reynolds` is 100, 400 or 1000; anything else is an
/// std::logic_error.
[[nodiscard]] CavityFit cavity_fit(const Grid& grid, std::span<const float> velocity, int reynolds);

} // namespace estampe::fluid
