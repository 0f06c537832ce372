// SPDX-License-Identifier: MIT
// MacCormack's scheme: Selle, Fedkiw, Kim, Liu and Rossignac, "An Unconditionally Stable MacCormack Method",
// Journal of Scientific Computing 35, 2008.
#include "techniques/fluid/motion/advection.hpp"

#include "shaders/fluid_advect_comp.hpp"
#include "shaders/fluid_correct_comp.hpp"

namespace estampe::fluid {

gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection, const Carried& carried,
                           float time_s)
{
    const bool are_scalars = carried.channels > 0;
    const WithGrid<shared::FluidAdvect> constants{
        grid_constants(grid),
        {.cells_per_speed = time_s / grid.cell_m,
         .channels = are_scalars ? carried.channels : grid.dimensions()}};
    const uint32_t bits = grid_bits(grid) | (are_scalars ? shared::fluid_bit_scalars : 0U);
    const bool is_corrected = advection == Advection::maccormack;

    auto advect = graph.compute("fluid/advect", shaders::fluid_advect_comp);
    advect.sample(carried.velocity, gpu::Sampling::linear_repeat)
        .sample(carried.field, gpu::Sampling::linear_repeat);
    const gpu::ImageId advected = advect.write(
        is_corrected ? graph.image("fluid/advected", graph.describe(carried.field)) : carried.target);
    advect.push(constants).variant(bits | (advection == Advection::cubic ? shared::fluid_bit_cubic : 0U));
    dispatch_over_cells(advect, grid);
    if (!is_corrected) {
        return advected;
    }
    auto correct = graph.compute("fluid/correct", shaders::fluid_correct_comp);
    correct.sample(carried.velocity, gpu::Sampling::linear_repeat)
        .sample(carried.field, gpu::Sampling::linear_repeat)
        .sample(advected, gpu::Sampling::linear_repeat);
    const gpu::ImageId corrected = correct.write(carried.target);
    correct.push(constants).variant(bits);
    dispatch_over_cells(correct, grid);
    return corrected;
}

} // namespace estampe::fluid
