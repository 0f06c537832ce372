// SPDX-License-Identifier: MIT
// Advection in both directions: West, "Practical Fluid Dynamics", Game Developer, 2007. Claims: Lentine,
// Grétarsson and Fedkiw, "An unconditionally stable fully conservative semi-Lagrangian method", Journal of
// Computational Physics 230, 2011.
#include "techniques/fluid/mass/mass.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/fluid_claim_comp.hpp"
#include "shaders/fluid_count_comp.hpp"
#include "shaders/fluid_gather_comp.hpp"
#include "shaders/fluid_scatter_comp.hpp"
#include "shaders/fluid_spread_comp.hpp"
#include "shaders/fluid_uncount_comp.hpp"

namespace estampe::fluid {
namespace {

std::vector<uint32_t> units_of(const Grid& grid, std::span<const float> mass)
{
    constexpr float most = 32768.0F;
    check_grid(grid);
    if (mass.size() != grid.cell_count()) {
        throw std::logic_error("a field of mass wants a number for each of its cells");
    }
    std::vector<uint32_t> units;
    for (const float number : mass) {
        if (!(number >= 0.0F && number <= most)) {
            throw std::logic_error("the mass of a cell is 0 to 32768");
        }
        units.push_back(static_cast<uint32_t>(
            std::llround(static_cast<double>(number) * static_cast<double>(shared::fluid_mass_unit))));
    }
    return units;
}

/// Masses that move along equal paths.
struct Masses {
    gpu::Name name; ///< name of the passes, such as "fluid/medium"
    gpu::BufferId units;
    uint32_t channels = 1;
    uint32_t bits = 0; ///< bits that are added to the shaders' `variant`
};

gpu::BufferId add_step(gpu::Graph& graph, const Grid& grid, const Masses& masses, const MassFlow& flow)
{
    const WithGrid<shared::FluidMass> constants{
        grid_constants(grid), {.cells_per_speed = flow.time_s / grid.cell_m, .channels = masses.channels}};
    const uint32_t variant = grid_bits(grid) | masses.bits;
    const uint64_t size_bytes = sizeof(uint32_t) * grid.cell_count();
    gpu::BufferId taken = gpu::add_zeros(graph, masses.name + " taken", masses.channels * size_bytes);
    gpu::BufferId next = gpu::add_zeros(graph, masses.name + " next", masses.channels * size_bytes);
    if (flow.advection == MassAdvection::both_ways) {
        const gpu::BufferId no_claims = gpu::add_zeros(graph, masses.name + " claims", size_bytes);
        auto claim = graph.compute(masses.name + " claim", shaders::fluid_claim_comp);
        claim.sample(flow.velocity, gpu::Sampling::linear_repeat);
        const gpu::BufferId claims = claim.modify(no_claims);
        claim.push(constants).variant(variant);
        dispatch_over_cells(claim, grid);
        auto gather = graph.compute(masses.name + " gather", shaders::fluid_gather_comp);
        gather.sample(flow.velocity, gpu::Sampling::linear_repeat)
            .sample(masses.units, gpu::Format::r32ui)
            .sample(claims, gpu::Format::r32ui);
        taken = gather.modify(taken);
        next = gather.write(next);
        gather.push(constants).variant(variant);
        dispatch_over_cells(gather, grid);
    }
    auto scatter = graph.compute(masses.name + " scatter", shaders::fluid_scatter_comp);
    scatter.sample(flow.velocity, gpu::Sampling::linear_repeat)
        .sample(masses.units, gpu::Format::r32ui)
        .sample(taken, gpu::Format::r32ui);
    next = scatter.modify(next);
    scatter.push(constants).variant(variant);
    dispatch_over_cells(scatter, grid);
    return next;
}

} // namespace

MassField::MassField(gpu::Device& device, const Grid& grid, std::span<const float> mass)
    : units_(gpu::upload_buffer(device, "fluid mass", units_of(grid, mass)))
{
}

gpu::BufferId MassField::import(gpu::Graph& graph)
{
    return gpu::import_whole(graph, "fluid/mass", units_);
}

void MassField::keep(gpu::Graph& graph, gpu::BufferId mass)
{
    gpu::add_copy_out(graph, "fluid/keep mass", mass, units_);
}

gpu::BufferId add_mass_step(gpu::Graph& graph, const Grid& grid, gpu::BufferId mass, const MassFlow& flow)
{
    return add_step(graph, grid, {.name = "fluid/medium", .units = mass}, flow);
}

gpu::ImageId add_spread(gpu::Graph& graph, const Grid& grid, const Spread& spread)
{
    const float gain =
        spread.stiffness_m2_s2 * spread.time_s / grid.cell_m / static_cast<float>(shared::fluid_mass_unit);
    auto pass = graph.compute("fluid/medium spread", shaders::fluid_spread_comp);
    const bool are_solids = spread.solids && spread.solids->are_any;
    pass.sample(spread.velocity)
        .sample(spread.mass, gpu::Format::r32ui)
        .sample(are_solids ? spread.solids->cells : spread.mass, gpu::Format::r32ui);
    const gpu::ImageId out = pass.write(spread.target);
    pass.push(WithGrid<shared::FluidMass>{grid_constants(grid),
                                          {.gain_per_unit = gain, .damping = spread.damping}})
        .variant(grid_bits(grid) | (are_solids ? shared::fluid_bit_solids : 0U));
    dispatch_over_cells(pass, grid);
    return out;
}

MassAndVelocity add_mass_pressure(gpu::Graph& graph, const Grid& grid, const Solids& solids,
                                  const MassAndVelocity& start, gpu::ImageId target, float time_s)
{
    constexpr float courant = 0.4F; // cells that sound crosses per part of a step; noise grows above 0.5
    // Mass moves with the mean speed of a cell's two faces. So a speed that alternates in sign from face to
    // face moves no mass and meets no pressure. Bulk viscosity damps alternating speeds.
    const float damping = grid.is_volume() ? 0.12F : 0.2F;
    const float part_s = time_s / static_cast<float>(mass_parts);
    const float sound_m_per_s = courant * grid.cell_m / part_s;
    // When mass moves to a neighbour cell, the method `both_ways` uses the speed in the middle of the
    // neighbour. The method `forward` uses the speed in the middle of the mass's own cell. The errors of the
    // two methods have opposite signs: one error makes waves grow that run with the flow, the other error
    // makes waves grow that run against the flow.
    MassAndVelocity now = start;
    for (uint32_t i = 0; i < mass_parts; ++i) {
        const bool is_last = i + 1 == mass_parts;
        now.mass =
            add_mass_step(graph, grid, now.mass,
                          {.velocity = now.velocity,
                           .time_s = part_s,
                           .advection = i % 2 == 0 ? MassAdvection::forward : MassAdvection::both_ways});
        now.velocity =
            add_spread(graph, grid,
                       {.mass = now.mass,
                        .velocity = now.velocity,
                        .target = is_last ? target : graph.image("fluid/medium spread", velocity_desc(grid)),
                        .solids = solids,
                        .stiffness_m2_s2 = sound_m_per_s * sound_m_per_s,
                        .time_s = part_s,
                        .damping = damping});
    }
    return now;
}

uint32_t passes_of_mass_pressure()
{
    return (4 + 7) * mass_parts / 2;
}

gpu::ImageId add_conserving_advection(gpu::Graph& graph, const Grid& grid, const Carried& carried,
                                      float time_s)
{
    const WithGrid<shared::FluidMass> constants{grid_constants(grid), {.channels = carried.channels}};
    const uint64_t size_bytes = sizeof(uint32_t) * carried.channels * grid.cell_count();
    auto count = graph.compute("fluid/count", shaders::fluid_count_comp);
    count.sample(carried.field);
    const gpu::BufferId units = count.write(graph.buffer("fluid/units", {.size_bytes = size_bytes}));
    count.push(constants).variant(grid_bits(grid));
    dispatch_over_cells(count, grid);
    const gpu::BufferId moved = add_step(graph, grid,
                                         {.name = "fluid/quantities",
                                          .units = units,
                                          .channels = carried.channels,
                                          .bits = shared::fluid_bit_scalars},
                                         {.velocity = carried.velocity, .time_s = time_s});
    auto uncount = graph.compute("fluid/uncount", shaders::fluid_uncount_comp);
    uncount.sample(moved, gpu::Format::r32ui);
    const gpu::ImageId out = uncount.write(carried.target);
    uncount.push(constants).variant(grid_bits(grid));
    dispatch_over_cells(uncount, grid);
    return out;
}

} // namespace estampe::fluid
