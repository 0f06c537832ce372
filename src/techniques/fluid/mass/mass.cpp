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
#include "shaders/fluid_gather_comp.hpp"
#include "shaders/fluid_scatter_comp.hpp"
#include "shaders/fluid_spread_comp.hpp"

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

} // namespace

MassField::MassField(gpu::Device& device, const Grid& grid, std::span<const float> mass)
    : grid_(grid), units_(gpu::upload_buffer(device, "fluid mass", units_of(grid, mass)))
{
}

gpu::BufferId MassField::import(gpu::Graph& graph)
{
    return gpu::import_whole(graph, "fluid/mass", units_);
}

gpu::BufferId MassField::add_step(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity, float time_s,
                                  MassAdvection advection) const
{
    const WithGrid<shared::FluidMass> constants{grid_constants(grid_),
                                                {.cells_per_speed = time_s / grid_.cell_m}};
    const uint64_t size_bytes = units_.size_bytes();
    gpu::BufferId taken = gpu::add_zeros(graph, "fluid/taken", size_bytes);
    gpu::BufferId next = gpu::add_zeros(graph, "fluid/next mass", size_bytes);
    if (advection == MassAdvection::both_ways) {
        const gpu::BufferId no_claims = gpu::add_zeros(graph, "fluid/claims", size_bytes);
        auto claim = graph.compute("fluid/claim", shaders::fluid_claim_comp);
        claim.sample(velocity, gpu::Sampling::linear_repeat);
        const gpu::BufferId claims = claim.modify(no_claims);
        claim.push(constants).variant(grid_bits(grid_));
        dispatch_over_cells(claim, grid_);
        auto gather = graph.compute("fluid/gather", shaders::fluid_gather_comp);
        gather.sample(velocity, gpu::Sampling::linear_repeat)
            .sample(mass, gpu::Format::r32ui)
            .sample(claims, gpu::Format::r32ui);
        taken = gather.modify(taken);
        next = gather.write(next);
        gather.push(constants).variant(grid_bits(grid_));
        dispatch_over_cells(gather, grid_);
    }
    auto scatter = graph.compute("fluid/scatter", shaders::fluid_scatter_comp);
    scatter.sample(velocity, gpu::Sampling::linear_repeat)
        .sample(mass, gpu::Format::r32ui)
        .sample(taken, gpu::Format::r32ui);
    next = scatter.modify(next);
    scatter.push(constants).variant(grid_bits(grid_));
    dispatch_over_cells(scatter, grid_);
    return next;
}

void MassField::keep(gpu::Graph& graph, gpu::BufferId mass)
{
    gpu::add_copy_out(graph, "fluid/keep mass", mass, units_);
}

gpu::ImageId MassField::add_spread(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity,
                                   float stiffness_m2_s2, float time_s) const
{
    const float gain = stiffness_m2_s2 * time_s / grid_.cell_m / static_cast<float>(shared::fluid_mass_unit);
    auto pass = graph.compute("fluid/spread", shaders::fluid_spread_comp);
    pass.sample(velocity).sample(mass, gpu::Format::r32ui);
    const gpu::ImageId spread = pass.write(graph.image("fluid/spread", velocity_desc(grid_)));
    pass.push(WithGrid<shared::FluidMass>{grid_constants(grid_), {.gain_per_unit = gain}})
        .variant(grid_bits(grid_));
    dispatch_over_cells(pass, grid_);
    return spread;
}

} // namespace estampe::fluid
