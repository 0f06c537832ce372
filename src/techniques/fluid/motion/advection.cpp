// SPDX-License-Identifier: MIT
// MacCormack's scheme: Selle, Fedkiw, Kim, Liu and Rossignac, "An Unconditionally Stable MacCormack Method",
// Journal of Scientific Computing 35, 2008.
#include "techniques/fluid/motion/advection.hpp"

#include "shaders/fluid_advect_comp.hpp"
#include "shaders/fluid_correct_comp.hpp"
#include "shaders/fluid_ways_comp.hpp"

namespace estampe::fluid {

Advection advection_for(const Grid& grid, Advection advection)
{
    return advection != Advection::automatic ? advection
           : grid.is_volume()                ? Advection::maccormack
                                             : Advection::cubic;
}

uint32_t passes_of_advection(const Grid& grid, Advection advection)
{
    return advection_for(grid, advection) == Advection::maccormack ? 3 : 1;
}

gpu::ImageId add_ways(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, float time_s)
{
    auto pass = graph.compute("fluid/ways", shaders::fluid_ways_comp);
    pass.sample(velocity, gpu::Sampling::linear_repeat);
    const gpu::ImageId ways = pass.write(graph.image("fluid/ways", vectors_desc(grid, 2)));
    pass.push(WithGrid<shared::FluidAdvect>{grid_constants(grid), {.cells_per_speed = time_s / grid.cell_m}})
        .variant(grid_bits(grid));
    dispatch_over_cells(pass, grid);
    return ways;
}

gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection, const Carried& carried,
                           float time_s)
{
    const bool are_scalars = carried.channels > 0;
    const WithGrid<shared::FluidAdvect> constants{
        grid_constants(grid),
        {.cells_per_speed = time_s / grid.cell_m,
         .channels = are_scalars ? carried.channels : grid.dimensions()}};
    const uint32_t bits = grid_bits(grid) | (are_scalars ? shared::fluid_bit_scalars : 0U);
    const Advection chosen = advection_for(grid, advection);
    const bool is_corrected = chosen == Advection::maccormack;
    std::optional<gpu::ImageId> ways = carried.ways;
    if (is_corrected && !ways) {
        ways = add_ways(graph, grid, carried.velocity, time_s);
    }

    auto advect = graph.compute("fluid/advect", shaders::fluid_advect_comp);
    advect.sample(carried.velocity, gpu::Sampling::linear_repeat)
        .sample(carried.field, gpu::Sampling::linear_repeat)
        .sample(ways.value_or(carried.velocity));
    const gpu::ImageId advected = advect.write(
        is_corrected ? graph.image("fluid/advected", graph.describe(carried.field)) : carried.target);
    advect.push(constants).variant(bits | (chosen == Advection::cubic ? shared::fluid_bit_cubic : 0U) |
                                   (ways ? shared::fluid_bit_ways : 0U));
    dispatch_over_cells(advect, grid);
    if (!is_corrected || !ways) {
        return advected;
    }
    auto correct = graph.compute("fluid/correct", shaders::fluid_correct_comp);
    correct.sample(*ways)
        .sample(carried.field, gpu::Sampling::linear_repeat)
        .sample(advected, gpu::Sampling::linear_repeat);
    const gpu::ImageId corrected = correct.write(carried.target);
    correct.push(constants).variant(bits);
    dispatch_over_cells(correct, grid);
    return corrected;
}

} // namespace estampe::fluid
