// SPDX-License-Identifier: MIT
#include "techniques/fluid/motion/forces.hpp"

#include <cmath>

#include "shaders/fluid_confine_comp.hpp"
#include "shaders/fluid_curl_comp.hpp"
#include "shaders/fluid_forces_comp.hpp"

namespace estampe::fluid {

namespace {

/// What feeds the vortices of a volume, in the middle of cells.
gpu::ImageId confining_force(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity)
{
    auto curl_pass = graph.compute("fluid/curl", shaders::fluid_curl_comp);
    curl_pass.sample(velocity);
    const gpu::ImageId curl = curl_pass.write(graph.image("fluid/curl", vectors_desc(grid, 1)));
    curl_pass.push(grid_constants(grid)).variant(grid_bits(grid));
    dispatch_over_cells(curl_pass, grid);
    auto pass = graph.compute("fluid/confine", shaders::fluid_confine_comp);
    pass.sample(curl);
    const gpu::ImageId force = pass.write(graph.image("fluid/confining", vectors_desc(grid, 1)));
    pass.push(grid_constants(grid)).variant(grid_bits(grid));
    dispatch_over_cells(pass, grid);
    return force;
}

} // namespace

gpu::ImageId add_forces(gpu::Graph& graph, const Grid& grid, const ForceStyle& style, gpu::ImageId velocity,
                        std::optional<gpu::ImageId> quantities, float time_s)
{
    if (style == ForceStyle{}) {
        return velocity;
    }
    const bool is_buoyant = quantities.has_value() && (style.lift_m_s2 != 0.0F || style.weight_m_s2 != 0.0F);
    const bool is_confined = style.confinement_per_s != 0.0F;
    const gpu::ImageId confining =
        is_confined && grid.is_volume() ? confining_force(graph, grid, velocity) : velocity;
    auto pass = graph.compute("fluid/forces", shaders::fluid_forces_comp);
    pass.sample(velocity, gpu::Sampling::linear_repeat)
        .sample(quantities.value_or(velocity))
        .sample(confining);
    const gpu::ImageId forced = pass.write(graph.image("fluid/forced", velocity_desc(grid)));
    pass.push(WithGrid<shared::FluidForces>{grid_constants(grid),
                                            {.speed_gain = time_s * style.acceleration_m_s2,
                                             .kept = std::exp(-style.friction_per_s * time_s),
                                             .lift = time_s * style.lift_m_s2,
                                             .weight = time_s * style.weight_m_s2,
                                             .confinement = time_s * style.confinement_per_s,
                                             .rim_share = 1.0F - std::exp(-style.rim.share_per_s * time_s),
                                             .rim_cells = style.rim.breadth_m / grid.cell_m,
                                             .outside = style.outside_m_s}})
        .variant(grid_bits(grid) | (is_buoyant ? shared::fluid_bit_buoyant : 0U) |
                 (is_confined ? shared::fluid_bit_confined : 0U));
    dispatch_over_cells(pass, grid);
    return forced;
}

} // namespace estampe::fluid
