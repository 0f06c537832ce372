// SPDX-License-Identifier: MIT
#pragma once

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// What one solve of a solver leaves of the equations of a random divergence without obstacles, over that
/// divergence, root mean squares in double precision. Cost: a solve, and a wait; meant for the start of a
/// program.
[[nodiscard]] double measured_residual(gpu::Device& device, gpu::Executor& executor, const Grid& grid,
                                       const ProjectionStyle& style);

} // namespace estampe::fluid
