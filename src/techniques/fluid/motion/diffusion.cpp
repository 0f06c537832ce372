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

shared::FluidDiffuse stage_of(uint32_t j, uint32_t stages, float share)
{
    const auto s = static_cast<float>(stages);
    const auto n = static_cast<float>(j);
    const float w = 4.0F / (s * s + s - 2.0F);
    if (j == 1) {
        return {.of_start = 1.0F, .of_start_rate = b_of(1) * w * share};
    }
    const float last = (2.0F * n - 1.0F) / n * b_of(j) / b_of(j - 1);
    const float before_last = -(n - 1.0F) / n * b_of(j) / b_of(j - 2);
    return {.of_last = last,
            .of_before_last = before_last,
            .of_start = 1.0F - last - before_last,
            .of_last_rate = last * w * share,
            .of_start_rate = -(1.0F - b_of(j - 1)) * last * w * share};
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

gpu::ImageId add_diffusion(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, float viscosity_m2_s,
                           float time_s)
{
    const float share = viscosity_m2_s * time_s / (grid.cell_m * grid.cell_m);
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
        pass.push(WithGrid<shared::FluidDiffuse>{grid_constants(grid), stage_of(j, stages, share)})
            .variant(grid_bits(grid));
        dispatch_over_cells(pass, grid);
    }
    return last;
}

} // namespace estampe::fluid
