// SPDX-License-Identifier: MIT
#pragma once

// Jacobi's iteration as a solver of the fluid's pressure equation.

#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {

/// Adds `rounds` Jacobi iterations that start from zero pressure. Cost: one pass per four iterations in 2D,
/// one pass per iteration in 3D.
[[nodiscard]] gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                       uint32_t rounds);

[[nodiscard]] uint32_t passes_of_jacobi(const Grid& grid, uint32_t rounds);

} // namespace estampe::fluid
