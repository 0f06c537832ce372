// SPDX-License-Identifier: MIT
// Flows whose solutions are known.
#include <gtest/gtest.h>

#include "techniques/fluid/fluid_test_support.hpp"

namespace estampe::fluid {
namespace {

constexpr double pi = std::numbers::pi;

/// Steps of a fluid, as many in a graph as it takes; what is left of the velocity.
std::vector<float> velocity_after(Fluid& fluid, const FluidStyle& style, uint32_t count, uint32_t at_once)
{
    std::vector<float> velocity;
    for (uint32_t left = count; left > 0;) {
        const uint32_t now = std::min(left, at_once);
        left -= now;
        gpu::Graph graph;
        const FluidFields fields = fluid.add_steps(graph, style, now);
        if (left == 0) {
            return run_and_read_layers(graph, fields.velocity);
        }
        static_cast<void>(run_and_read_layers(graph, fields.velocity));
    }
    return velocity;
}

double energy_of(const std::vector<float>& velocity)
{
    double sum = 0.0;
    for (const float speed : velocity) {
        sum += static_cast<double>(speed) * static_cast<double>(speed);
    }
    return sum;
}

/// Energy that a Taylor-Green vortex keeps until 2 pi, at a Courant number of 1.
double energy_kept(uint32_t side, FluidStyle style)
{
    const Grid grid{.cells = {side, side, 1},
                    .cell_m = static_cast<float>(2.0 * pi / side),
                    .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    const std::vector<float> start = velocity_of(grid, [](glm::dvec3 p) {
        return glm::dvec3(std::sin(p.x) * std::cos(p.y), -std::cos(p.x) * std::sin(p.y), 0.0);
    });
    style.step_s = grid.cell_m;
    Fluid fluid(test::shared_device(), grid, 0, start);
    return energy_of(velocity_after(fluid, style, side, 2)) / energy_of(start);
}

TEST(FluidFlows, TaylorGreenVorticesDecayByTheirViscosityAlone)
{
    const double kept = energy_kept(128, {.viscosity_m2_s = 0.01F});
    EXPECT_NEAR(kept, std::exp(-0.04 * 2.0 * pi), 0.003);
    fmt::print("{:.5f}\n", kept);
    for (const Stepping stepping : {Stepping::reflect, Stepping::project}) {
        for (const Advection advection : {Advection::linear, Advection::maccormack, Advection::cubic}) {
            const double at64 = energy_kept(64, {.stepping = stepping, .velocity_advection = advection});
            const double at32 = energy_kept(32, {.stepping = stepping, .velocity_advection = advection});
            fmt::print("{} {} : {:.5f} {:.5f} order {:.3f}\n", (int)stepping, (int)advection, at32, at64,
                       std::log2((1.0 - at32) / (1.0 - at64)));
        }
    }
}

} // namespace
} // namespace estampe::fluid
