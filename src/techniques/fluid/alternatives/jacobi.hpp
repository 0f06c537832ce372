// SPDX-License-Identifier: MIT
#pragma once

// Jacobi's iteration for the pressure equation.

#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {

/// Adds `rounds` rounds that start from zero. Cost: one pass per four rounds in 2D, one per round in 3D.
[[nodiscard]] gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                       uint32_t rounds);

[[nodiscard]] uint32_t passes_of_jacobi(const Grid& grid, uint32_t rounds);

} // namespace estampe::fluid
