// SPDX-License-Identifier: MIT
// The Runge-Kutta-Legendre scheme of second order, explicit, whose stability grows with the square of its
// stages: Meyer, Balsara and Aslam, "A stabilized Runge-Kutta-Legendre method for explicit
// super-time-stepping of parabolic and mixed equations", Journal of Computational Physics 257, 2014.
#include "techniques/fluid/motion/diffusion.hpp"

#include <stdexcept>

#include "shaders/fluid_diffuse_comp.hpp"

namespace estampe::fluid {
namespace {

constexpr uint32_t most_stages = 63;

float b_of(uint32_t j)
{
    const auto n = static_cast<float>(j < 2 ? 2 : j);
    return (n * n + n - 2.0F) / (2.0F * n * (n + 1.0F));
}

/// Weights of a stage for rates of change over the whole time.
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

} // namespace estampe::fluid
