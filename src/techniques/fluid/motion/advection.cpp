// SPDX-License-Identifier: MIT
// MacCormack's scheme: Selle, Fedkiw, Kim, Liu and Rossignac, "An Unconditionally Stable MacCormack Method",
// Journal of Scientific Computing 35, 2008.
#include "techniques/fluid/motion/advection.hpp"

#include <stdexcept>

#include "shaders/fluid_advect_comp.hpp"
#include "shaders/fluid_correct_comp.hpp"
#include "shaders/fluid_ways_comp.hpp"

namespace estampe::fluid {

namespace {

WithGrid<shared::FluidAdvect> constants_of(const Grid& grid, const Carried& carried, float time_s)
{
    return {grid_constants(grid),
            {.cells_per_speed = time_s / grid.cell_m,
             .channels = carried.channels > 0 ? carried.channels : grid.dimensions()}};
}

uint32_t bits_of(const Grid& grid, const Carried& carried)
{
    return grid_bits(grid) | (carried.channels > 0 ? shared::fluid_bit_scalars : 0U);
}

/// Semi-Lagrangian, into `target`.
gpu::ImageId add_advect(gpu::Graph& graph, const Grid& grid, const Carried& carried, gpu::ImageId target,
                        uint32_t bits, float time_s)
{
    auto pass = graph.compute("fluid/advect", shaders::fluid_advect_comp);
    pass.sample(carried.velocity, gpu::Sampling::linear_repeat)
        .sample(carried.field, gpu::Sampling::linear_repeat)
        .sample(carried.ways.value_or(carried.velocity));
    const gpu::ImageId advected = pass.write(target);
    pass.push(constants_of(grid, carried, time_s))
        .variant(bits_of(grid, carried) | bits | (carried.ways ? shared::fluid_bit_ways : 0U));
    dispatch_over_cells(pass, grid);
    return advected;
}

} // namespace

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

ThereAndBack add_there(gpu::Graph& graph, const Grid& grid, const Carried& carried, float time_s)
{
    Carried there = carried;
    if (!there.ways) {
        there.ways = add_ways(graph, grid, carried.velocity, time_s);
    }
    const gpu::ImageId target = graph.image("fluid/advected", graph.describe(carried.field));
    return {.ways = *there.ways,
            .field = carried.field,
            .advected = add_advect(graph, grid, there, target, 0, time_s)};
}

gpu::ImageId add_advection(gpu::Graph& graph, const Grid& grid, Advection advection, const Carried& carried,
                           float time_s)
{
    const Advection chosen = advection_for(grid, advection);
    if (chosen != Advection::maccormack) {
        const uint32_t bits = chosen == Advection::cubic ? shared::fluid_bit_cubic : 0U;
        return add_advect(graph, grid, carried, carried.target, bits, time_s);
    }
    if (carried.channels > 0) {
        throw std::logic_error("what MacCormack's scheme carries of quantities is corrected as it changes");
    }
    const ThereAndBack found = add_there(graph, grid, carried, time_s);
    auto correct = graph.compute("fluid/correct", shaders::fluid_correct_comp);
    correct.sample(found.ways)
        .sample(found.field, gpu::Sampling::linear_repeat)
        .sample(found.advected, gpu::Sampling::linear_repeat);
    const gpu::ImageId corrected = correct.write(carried.target);
    correct.push(grid_constants(grid)).variant(grid_bits(grid));
    dispatch_over_cells(correct, grid);
    return corrected;
}

} // namespace estampe::fluid
