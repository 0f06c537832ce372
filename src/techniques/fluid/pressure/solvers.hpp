// SPDX-License-Identifier: MIT
#pragma once

// The solvers of the pressure's equation: from what flows out of each cell the pressure of each cell, such
// that the sum over a cell's open faces of pressure there less pressure here is what flows out.

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

struct Equation {
    gpu::BufferId divergence;
    gpu::BufferId weights;
};

[[nodiscard]] gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                       uint32_t rounds);

/// One V(2,2) cycle from zero.
[[nodiscard]] gpu::BufferId add_v_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);

} // namespace estampe::fluid
