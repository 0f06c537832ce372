// SPDX-License-Identifier: MIT
#pragma once

// Jacobi's iteration for the pressure's equation.

#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {

/// So many rounds from zero. Cost: in planes four rounds a pass, in volumes one.
[[nodiscard]] gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                       uint32_t rounds);

[[nodiscard]] uint32_t passes_of_jacobi(const Grid& grid, uint32_t rounds);

} // namespace estampe::fluid
