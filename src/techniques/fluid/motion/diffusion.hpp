// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// Stages that diffusion takes to be stable: 2 for little viscosity, more with the root of it. `share` is
/// viscosity times time over the square of a cell's side. Throws std::logic_error above 63.
[[nodiscard]] uint32_t diffusion_stages(const Grid& grid, float share);

struct Diffusion {
    float viscosity_m2_s = 0.0F;
    glm::vec3 acceleration_m_s2{
        0.0F}; ///< everywhere: what walls hold back at once must not be added afterwards
    float time_s = 0.0F;
};

/// `velocity` after it.
[[nodiscard]] gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                         const Diffusion& diffusion);

} // namespace estampe::fluid
