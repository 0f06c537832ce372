// SPDX-License-Identifier: MIT
// MacCormack's scheme: Selle, Fedkiw, Kim, Liu and Rossignac, "An Unconditionally Stable MacCormack Method",
// Journal of Scientific Computing 35, 2008.
#include "techniques/fluid/motion/motion.hpp"

#include <cmath>
#include <stdexcept>

#include "shaders/fluid_advect_comp.hpp"
#include "shaders/fluid_confine_comp.hpp"
#include "shaders/fluid_correct_comp.hpp"
#include "shaders/fluid_curl_comp.hpp"
#include "shaders/fluid_diffuse_comp.hpp"
#include "shaders/fluid_forces_comp.hpp"
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

// Viscous diffusion by the second-order Runge-Kutta-Legendre scheme, which is explicit; the scheme's
// stability limit grows with the square of the number of stages. Source: Meyer, Balsara and Aslam, "A
// stabilized Runge-Kutta-Legendre method for explicit super-time-stepping of parabolic and mixed equations",
// Journal of Computational Physics 257, 2014.

namespace {

constexpr uint32_t most_stages = 63;

float b_of(uint32_t j)
{
    const auto n = static_cast<float>(j < 2 ? 2 : j);
    return (n * n + n - 2.0F) / (2.0F * n * (n + 1.0F));
}

/// Weights of stage `j` of the Runge-Kutta-Legendre scheme. Weights of rates of change are for the whole time
/// step.
shared::FluidDiffuse stage_of(uint32_t j, uint32_t stages)
{
    const auto s = static_cast<float>(stages);
    const auto n = static_cast<float>(j);
    const float w = 4.0F / (s * s + s - 2.0F);
    if (j == 1) {
        return {.of_start = 1.0F, .of_start_rate = b_of(1) * w};
    }
    const float last = (2.0F * n - 1.0F) / n * b_of(j) / b_of(j - 1);
    const float before_last = -(n - 1.0F) / n * b_of(j) / b_of(j - 2);
    return {.of_last = last,
            .of_before_last = before_last,
            .of_start = 1.0F - last - before_last,
            .of_last_rate = last * w,
            .of_start_rate = -(1.0F - b_of(j - 1)) * last * w};
}

} // namespace

uint32_t diffusion_stages(const Grid& grid, float share)
{
    const float explicit_share = 0.5F / static_cast<float>(grid.dimensions());
    for (uint32_t s = 2; s <= most_stages; ++s) {
        if (share <= explicit_share * static_cast<float>(s * s + s - 2) / 4.0F) {
            return s;
        }
    }
    throw std::logic_error("a fluid too viscous for its cells: make the step shorter or the cells larger");
}

gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                           const Diffusion& diffusion)
{
    const float share = diffusion.viscosity_m2_s * diffusion.time_s / (grid.cell_m * grid.cell_m);
    const uint32_t stages = diffusion_stages(grid, share);
    gpu::ImageId last = velocity;
    gpu::ImageId before_last = velocity;
    for (uint32_t j = 1; j <= stages; ++j) {
        auto pass = graph.compute("fluid/diffuse", shaders::fluid_diffuse_comp);
        pass.sample(velocity, gpu::Sampling::linear_repeat)
            .sample(last, gpu::Sampling::linear_repeat)
            .sample(before_last, gpu::Sampling::linear_repeat);
        before_last = last;
        last = pass.write(graph.image("fluid/diffused", velocity_desc(grid)));
        shared::FluidDiffuse stage = stage_of(j, stages);
        stage.speed_gain =
            (stage.of_last_rate + stage.of_start_rate) * diffusion.time_s * diffusion.acceleration_m_s2;
        stage.of_last_rate *= share;
        stage.of_start_rate *= share;
        pass.push(WithGrid<shared::FluidDiffuse>{grid_constants(grid), stage}).variant(grid_bits(grid));
        dispatch_over_cells(pass, grid);
    }
    return last;
}

namespace {

/// Constants of the confinement in a step of `time_s`.
shared::FluidConfine confine_constants(const Grid& grid, const ForceStyle& style, float time_s)
{
    // A swirl that turns as a rigid body has a vorticity of twice its angular speed.
    return {.surplus = style.surplus_per_s > 0.0F ? style.surplus_per_s / style.confinement_per_s : 0.0F,
            .swirl_most = 2.0F * most_turn_rad * grid.cell_m / time_s};
}

/// Vorticity confinement force of a 3D fluid, at cell centres.
gpu::ImageId confining_force(gpu::Graph& graph, const Grid& grid, const shared::FluidConfine& constants,
                             gpu::ImageId velocity)
{
    auto curl_pass = graph.compute("fluid/curl", shaders::fluid_curl_comp);
    curl_pass.sample(velocity);
    const gpu::ImageId curl = curl_pass.write(graph.image("fluid/curl", vectors_desc(grid, 1)));
    curl_pass.push(grid_constants(grid)).variant(grid_bits(grid));
    dispatch_over_cells(curl_pass, grid);
    auto pass = graph.compute("fluid/confine", shaders::fluid_confine_comp);
    pass.sample(curl);
    const gpu::ImageId force = pass.write(graph.image("fluid/confining", vectors_desc(grid, 1)));
    pass.push(WithGrid<shared::FluidConfine>{grid_constants(grid), constants}).variant(grid_bits(grid));
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
        is_confined && grid.is_volume()
            ? confining_force(graph, grid, confine_constants(grid, style, time_s), velocity)
            : velocity;
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
                                             .outside = style.outside_m_per_s}})
        .variant(grid_bits(grid) | (is_buoyant ? shared::fluid_bit_buoyant : 0U) |
                 (is_confined ? shared::fluid_bit_confined : 0U));
    dispatch_over_cells(pass, grid);
    return forced;
}

} // namespace estampe::fluid
