// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/expansion.hpp"

#include <cmath>

#include "shaders/fluid_expand_comp.hpp"
#include "shaders/fluid_swell_comp.hpp"
#include "shaders/fluid_vent_comp.hpp"

namespace estampe::fluid {
namespace {

uint32_t part_count(const Grid& grid)
{
    constexpr uint32_t group = 8;
    return (grid.cells.x + group - 1) / group * ((grid.cells.y + group - 1) / group) * grid.cells.z;
}

gpu::BufferId add_swell(gpu::Graph& graph, const char* name, const Grid& grid, const Swelling& swelling,
                        gpu::BufferId numbers, uint32_t bits)
{
    auto pass = graph.compute(name, shaders::fluid_swell_comp);
    pass.sample(swelling.wanted, gpu::Format::r32f)
        .sample(swelling.share, gpu::Format::r32f)
        .sample(swelling.solids.cells, gpu::Format::r32ui)
        .sample(numbers, gpu::Format::r32ui);
    const gpu::BufferId swollen =
        pass.write(graph.buffer("fluid/swollen", {.size_bytes = sizeof(uint32_t) * grid.cell_count()}));
    pass.push(WithGrid<shared::FluidExpansion>{grid_constants(grid), {.rim_cells = swelling.rim_cells}})
        .variant(grid_bits(grid) | bits | (swelling.solids.are_any ? shared::fluid_bit_solids : 0U));
    dispatch_over_cells(pass, grid);
    return swollen;
}

} // namespace

Swelling add_swelling(gpu::Graph& graph, const Grid& grid, const MatterStyle& style, const Hot& hot)
{
    const uint32_t parts = part_count(grid);
    const WithGrid<shared::FluidExpansion> constants{
        grid_constants(grid),
        {.expands_above = style.expands_above,
         .excess_kept = std::exp(-style.expansion_per_s * hot.step_s),
         .speed_per_log = grid.cell_m / hot.step_s,
         .rim_cells = style.rim.breadth_m / grid.cell_m,
         .part_count = parts}};
    const uint32_t variant = grid_bits(grid) | (hot.solids.are_any ? shared::fluid_bit_solids : 0U) |
                             (hot.mass ? shared::fluid_bit_massive : 0U);
    auto expand = graph.compute("fluid/expand", shaders::fluid_expand_comp);
    expand.sample(hot.quantities)
        .sample(hot.solids.cells, gpu::Format::r32ui)
        .sample(hot.mass.value_or(hot.solids.cells), gpu::Format::r32ui);
    const gpu::BufferId wanted =
        expand.write(graph.buffer("fluid/wanted", {.size_bytes = sizeof(float) * grid.cell_count()}));
    const gpu::BufferId sums =
        expand.write(graph.buffer("fluid/parts", {.size_bytes = 2 * sizeof(float) * uint64_t{parts}}));
    expand.push(constants).variant(variant);
    dispatch_over_cells(expand, grid);
    auto vent = graph.compute("fluid/vent", shaders::fluid_vent_comp);
    vent.read(sums);
    const gpu::BufferId share = vent.write(graph.buffer("fluid/share", {.size_bytes = sizeof(float)}));
    vent.push(constants).dispatch(1);
    return {.wanted = wanted, .share = share, .solids = hot.solids, .rim_cells = constants.rest.rim_cells};
}

gpu::BufferId add_swelling_to_outflow(gpu::Graph& graph, const Grid& grid, const Swelling& swelling,
                                      gpu::BufferId outflow, const char* name)
{
    return add_swell(graph, name, grid, swelling, outflow, 0);
}

gpu::BufferId add_swelling_to_mass(gpu::Graph& graph, const Grid& grid, const Swelling& swelling,
                                   gpu::BufferId mass)
{
    return add_swell(graph, "fluid/swell", grid, swelling, mass, shared::fluid_bit_massive);
}

} // namespace estampe::fluid
