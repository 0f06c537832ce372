// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// Stages that diffusion takes to be stable: 2 for little viscosity, more with the root of it. `share` is
/// viscosity times time over the square of a cell's side. Throws std::logic_error above 63.
[[nodiscard]] uint32_t diffusion_stages(const Grid& grid, float share);

/// `velocity` after `time_s` of viscosity.
[[nodiscard]] gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                         float viscosity_m2_s, float time_s);

} // namespace estampe::fluid
