// SPDX-License-Identifier: MIT
#include "techniques/fluid/alternatives/jacobi.hpp"

#include <algorithm>

#include "gpu/transfers.hpp"
#include "shaders/fluid_jacobi_comp.hpp"
#include "shaders/fluid_jacobi_volume_comp.hpp"

namespace estampe::fluid {
namespace {

gpu::BufferId add_rounds(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                         gpu::BufferId pressure, uint32_t count)
{
    const auto tiles = [](uint32_t cells) { return (cells - 1) / shared::fluid_tile + 1; };
    const shared::FluidLevel level = levels_of(grid).front();
    auto pass = graph.compute("fluid/jacobi", shaders::fluid_jacobi_comp);
    pass.sample(equation.divergence, gpu::Format::r32f)
        .sample(equation.weights, gpu::Format::r32ui)
        .sample(pressure, gpu::Format::r32f);
    const gpu::BufferId next =
        pass.write(graph.buffer("fluid/pressure", {.size_bytes = sizeof(float) * grid.cell_count()}));
    pass.push(shared::FluidTile{.level = level, .coarse = level, .rounds = count})
        .variant(grid_bits(grid))
        .dispatch(tiles(level.width), tiles(level.height));
    return next;
}

gpu::BufferId add_round_in_volume(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                  gpu::BufferId pressure)
{
    auto pass = graph.compute("fluid/jacobi", shaders::fluid_jacobi_volume_comp);
    pass.sample(equation.divergence, gpu::Format::r32f)
        .sample(equation.solids.cells, gpu::Format::r32ui)
        .sample(pressure, gpu::Format::r32f);
    const gpu::BufferId next =
        pass.write(graph.buffer("fluid/pressure", {.size_bytes = sizeof(float) * grid.cell_count()}));
    pass.push(grid_constants(grid))
        .variant(grid_bits(grid) | (equation.solids.are_any ? shared::fluid_bit_solids : 0U));
    dispatch_over_cells(pass, grid);
    return next;
}

} // namespace

uint32_t passes_of_jacobi(const Grid& grid, uint32_t rounds)
{
    return 1 +
           (grid.is_volume() ? rounds : (rounds + shared::fluid_most_rounds - 1) / shared::fluid_most_rounds);
}

gpu::BufferId add_jacobi(gpu::Graph& graph, const Grid& grid, const Equation& equation, uint32_t rounds)
{
    gpu::BufferId pressure = gpu::add_zeros(graph, "fluid/zeros", sizeof(float) * grid.cell_count());
    for (uint32_t left = rounds; left > 0;) {
        const uint32_t count = grid.is_volume() ? 1 : std::min(left, shared::fluid_most_rounds);
        left -= count;
        pressure = grid.is_volume() ? add_round_in_volume(graph, grid, equation, pressure)
                                    : add_rounds(graph, grid, equation, pressure, count);
    }
    return pressure;
}

} // namespace estampe::fluid
