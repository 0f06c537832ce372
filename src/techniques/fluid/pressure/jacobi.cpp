// SPDX-License-Identifier: MIT
#include <algorithm>

#include "gpu/fills.hpp"
#include "shaders/fluid_jacobi_comp.hpp"
#include "techniques/fluid/pressure/levels.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {

gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation, uint32_t rounds)
{
    const shared::FluidLevel level = levels_of(grid).front();
    const uint64_t size_bytes = sizeof(float) * uint64_t{cell_count(level)};
    gpu::BufferId pressure = gpu::add_zeros(graph, "fluid/zeros", size_bytes);
    for (uint32_t left = rounds; left > 0;) {
        const uint32_t count = std::min(left, shared::fluid_most_rounds);
        left -= count;
        auto pass = graph.compute("fluid/jacobi", shaders::fluid_jacobi_comp);
        pass.sample(equation.divergence, gpu::Format::r32f)
            .sample(equation.weights, gpu::Format::r32ui)
            .sample(pressure, gpu::Format::r32f);
        pressure = pass.write(graph.buffer("fluid/pressure", {.size_bytes = size_bytes}));
        pass.push(shared::FluidTile{.level = level, .coarse = level, .rounds = count})
            .variant(grid_bits(grid))
            .dispatch((level.width - 1) / shared::fluid_tile + 1,
                      (level.height - 1) / shared::fluid_tile + 1);
    }
    return pressure;
}

} // namespace estampe::fluid
