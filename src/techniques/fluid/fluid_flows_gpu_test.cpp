// SPDX-License-Identifier: MIT
// Flows with known solutions.
#include <array>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "techniques/fluid/cavity.hpp"
#include "techniques/fluid/fluid_test_support.hpp"

namespace estampe::fluid {
namespace {

constexpr double pi = std::numbers::pi;

double energy_of(const std::vector<float>& velocity)
{
    double sum = 0.0;
    for (const float speed : velocity) {
        sum += static_cast<double>(speed) * static_cast<double>(speed);
    }
    return sum;
}

/// Share of the energy of a Taylor-Green vortex that is left at time 2 pi, at a Courant number of 1.
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
    return energy_of(velocity_after(fluid, style, side)) / energy_of(start);
}

/// Convergence order of the numerical energy loss, measured with half the cells and steps.
double order_of_loss(uint32_t side, const FluidStyle& style)
{
    return std::log2((1.0 - energy_kept(side / 2, style)) / (1.0 - energy_kept(side, style)));
}

TEST(FluidFlows, TaylorGreenVorticesDecayByTheirViscosity)
{
    const double exact = std::exp(-4.0 * 0.01 * 2.0 * pi);
    EXPECT_NEAR(energy_kept(128, {.viscosity_m2_s = 0.01F}), exact, 0.003);
    EXPECT_NEAR(energy_kept(128, {.velocity_advection = Advection::maccormack, .viscosity_m2_s = 0.01F}),
                exact, 0.003);
    // Checks the measure itself: with half the cells both methods are still close, and linear weights fail.
    EXPECT_NEAR(energy_kept(64, {.viscosity_m2_s = 0.01F}), exact, 0.01);
    EXPECT_NEAR(energy_kept(64, {.velocity_advection = Advection::maccormack, .viscosity_m2_s = 0.01F}),
                exact, 0.01);
    EXPECT_LT(energy_kept(64, {.velocity_advection = Advection::linear, .viscosity_m2_s = 0.01F}),
              exact - 0.1);
}

TEST(FluidFlows, ReflectionIsOfSecondOrderAndPlainProjectionOfFirst)
{
    for (const Advection advection : {Advection::maccormack, Advection::cubic}) {
        EXPECT_GE(order_of_loss(64, {.velocity_advection = advection}), 1.9);
        const double plain =
            order_of_loss(128, {.stepping = Stepping::project, .velocity_advection = advection});
        EXPECT_GE(plain, 0.8);
        EXPECT_LE(plain, 1.2);
    }
}

TEST(FluidFlows, ShearDecaysByDiffusionAlone)
{
    const Grid grid{.cells = {8, 64, 1},
                    .cell_m = static_cast<float>(2.0 * pi / 64.0),
                    .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    for (const double waves : {1.0, 3.0}) {
        for (const float viscosity : {0.05F, 2.0F}) {
            const std::vector<float> start =
                velocity_of(grid, [&](glm::dvec3 p) { return glm::dvec3(std::sin(waves * p.y), 0.0, 0.0); });
            const auto rate = static_cast<double>(viscosity) * waves * waves;
            constexpr uint32_t steps = 40;
            Fluid fluid(test::shared_device(), grid, 0, start);
            const std::vector<float> end = velocity_after(
                fluid, {.step_s = static_cast<float>(1.0 / rate / steps), .viscosity_m2_s = viscosity},
                steps);
            // The grid's second differences are slightly smaller than the sine's second derivative.
            const auto h = static_cast<double>(grid.cell_m);
            const double seen = std::pow(std::sin(0.5 * waves * h) / (0.5 * waves * h), 2.0);
            EXPECT_NEAR(std::sqrt(energy_of(end) / energy_of(start)) / std::exp(-seen), 1.0, 1e-3)
                << waves << " waves, " << viscosity << " m2/s";
        }
    }
}

/// Speed between walls at y = -a and a under a force per mass f that starts at time 0.
double channel_speed(double y, double time_s, double a, double f, double viscosity)
{
    double speed = f / (2.0 * viscosity) * (a * a - y * y);
    for (int n = 0; n < 40; ++n) {
        const double odd = 2.0 * n + 1.0;
        const double rate = viscosity * std::pow(odd * pi / (2.0 * a), 2.0);
        speed -= 16.0 * f * a * a * (n % 2 == 0 ? 1.0 : -1.0) / (viscosity * std::pow(odd * pi, 3.0)) *
                 std::cos(odd * pi * y / (2.0 * a)) * std::exp(-rate * time_s);
    }
    return speed;
}

TEST(FluidFlows, ChannelsStartAsPoiseuilleFlowDoes)
{
    constexpr double a = 0.5;
    constexpr double f = 0.8;
    constexpr double viscosity = 0.1;
    constexpr double fastest = f * a * a / (2.0 * viscosity);
    const Grid grid{
        .cells = {8, 64, 1}, .cell_m = 1.0F / 64.0F, .edges = {Edge::periodic, Edge::no_slip, Edge::no_slip}};
    Fluid fluid(test::shared_device(), grid);
    const FluidStyle style{.step_s = 0.02F,
                           .viscosity_m2_s = static_cast<float>(viscosity),
                           .forces = {.acceleration_m_s2 = {static_cast<float>(f), 0.0F, 0.0F}}};
    double time_s = 0.0;
    for (const uint32_t steps : {10U, 20U, 40U, 400U}) {
        const std::vector<float> velocity = velocity_after(fluid, style, steps);
        time_s += 0.02 * steps;
        double worst = 0.0;
        for (uint32_t j = 0; j < 64; ++j) {
            const double exact = channel_speed((j + 0.5) / 64.0 - a, time_s, a, f, viscosity);
            worst = std::max(worst, std::abs(static_cast<double>(velocity[j * 8 + 3]) - exact));
        }
        EXPECT_LE(worst, 0.005 * fastest) << time_s << " s";
    }
}

TEST(FluidFlows, ALidDrivesItsCavityAsGhiaGhiaAndShinFound)
{
    const Grid grid = cavity_grid(64);
    const auto fit = [&](Advection advection, uint32_t seconds) {
        Fluid fluid(test::shared_device(), grid);
        const FluidStyle style{
            .step_s = grid.cell_m, .velocity_advection = advection, .viscosity_m2_s = 1.0F / 100.0F};
        return cavity_fit(grid, velocity_after(fluid, style, 64 * seconds), 100);
    };
    for (const Advection advection : {Advection::maccormack, Advection::automatic}) {
        const CavityFit sharp = fit(advection, 12);
        EXPECT_LE(sharp.rms_u, 0.0025);
        EXPECT_LE(sharp.rms_v, 0.0045);
        // Reference extremes: Marchi, Suero and Araki, 2009.
        EXPECT_NEAR(sharp.least_u, -0.2140417, 0.02 * 0.214);
        EXPECT_NEAR(sharp.most_v, 0.1795728, 0.02 * 0.18);
        EXPECT_NEAR(sharp.least_v, -0.2538030, 0.02 * 0.254);
    }
    EXPECT_GE(fit(Advection::linear, 8).rms_u, 0.004) << "linear weights blur, and the measure tells";
}

TEST(FluidFlows, VolumesFlowAsPlanesDoWhateverWayTheyLie)
{
    const auto vortices = [](double a, double b) {
        return glm::dvec2(std::sin(a) * std::cos(b), -std::cos(a) * std::sin(b));
    };
    constexpr uint32_t side = 32;
    FluidStyle style{.step_s = static_cast<float>(2.0 * pi / side), .viscosity_m2_s = 0.02F};
    const auto kept = [&](const Grid& grid, const Flow& flow) {
        const std::vector<float> start = velocity_of(grid, flow);
        Fluid fluid(test::shared_device(), grid, 0, start);
        return energy_of(velocity_after(fluid, style, 6)) / energy_of(start);
    };
    const auto grid_of = [&](glm::uvec3 cells) {
        return Grid{.cells = cells,
                    .cell_m = style.step_s,
                    .edges = {Edge::periodic, Edge::periodic, Edge::periodic}};
    };
    const auto turned = [&](glm::dvec3 p) {
        const glm::dvec2 speed = vortices(p.z, p.y);
        return glm::dvec3(0.0, speed.y, speed.x);
    };
    const auto level = [&](glm::dvec3 p) { return glm::dvec3(vortices(p.x, p.y), 0.0); };
    for (const Advection advection : {Advection::maccormack, Advection::cubic}) {
        style.velocity_advection = advection;
        const double flat = kept(grid_of({side, side, 1}), level);
        EXPECT_LT(flat, 0.95);
        EXPECT_NEAR(kept(grid_of({side, side, 4}), level), flat, 1e-5);
        EXPECT_NEAR(kept(grid_of({4, side, side}), turned), flat, 1e-5);
    }
}

/// Advects a room full of eddies by splines. Axes with a bit in `axes` are mirrored before and mirrored back
/// afterwards.
std::vector<float> stirred_in_mirror(const Grid& grid, uint32_t axes)
{
    const auto is_turned = [&](int axis) { return (axes >> static_cast<uint32_t>(axis) & 1U) != 0; };
    const auto in_mirror = [&](glm::dvec3 place) {
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = is_turned(axis) ? 1.0 - place[axis] : place[axis];
        }
        return place;
    };
    const Flow eddies = [&](glm::dvec3 place) {
        const glm::dvec3 sine = glm::sin(pi * in_mirror(place));
        const glm::dvec3 cosine = glm::cos(pi * in_mirror(place));
        glm::dvec3 speed(sine.x * cosine.y, -cosine.x * sine.y, 0.0);
        speed += grid.is_volume() ? glm::dvec3(0.0, sine.y * cosine.z, -cosine.y * sine.z) : glm::dvec3(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            speed[axis] = is_turned(axis) ? -speed[axis] : speed[axis];
        }
        return speed;
    };
    const auto amount = over_nodes(grid, 1, [&](uint32_t, glm::uvec3 cell) {
        const glm::dvec3 at = in_mirror((glm::dvec3(cell) + 0.5) * static_cast<double>(grid.cell_m));
        return std::sin(7.0 * at.x) + std::sin(5.0 * at.y + 1.0) +
               (grid.is_volume() ? std::cos(6.0 * at.z) : 0.0);
    });
    Fluid fluid(test::shared_device(), grid, 1, velocity_of(grid, eddies), amount);
    gpu::Graph graph;
    const FluidStyle style{
        .step_s = 0.15F, .velocity_advection = Advection::cubic, .quantity_advection = Advection::cubic};
    const auto left = run_and_read_layers(graph, *fluid.add_steps(graph, style, 1).quantities);
    return over_nodes(grid, 1, [&](uint32_t, glm::uvec3 cell) {
        for (int axis = 0; axis < static_cast<int>(grid.dimensions()); ++axis) {
            cell[axis] = is_turned(axis) ? grid.cells[axis] - 1 - cell[axis] : cell[axis];
        }
        return left[(cell.z * grid.cells.y + cell.y) * grid.cells.x + cell.x];
    });
}

TEST(FluidFlows, SplinesTreatWallsAtBothEndsAlike)
{
    constexpr uint32_t side = 16;
    for (const uint32_t depth : {1U, side}) {
        const Grid grid{.cells = {side, side, depth}, .cell_m = 1.0F / side};
        const auto here = stirred_in_mirror(grid, 0);
        for (const uint32_t axes : depth > 1 ? std::vector{1U, 2U, 4U, 7U} : std::vector{1U, 2U, 3U}) {
            const auto there = stirred_in_mirror(grid, axes);
            double worst = 0.0;
            for (size_t i = 0; i < here.size(); ++i) {
                worst = std::max(worst, static_cast<double>(std::abs(here[i] - there[i])));
            }
            EXPECT_LT(worst, 1e-4) << "axes " << axes << ", " << depth << " cells deep";
        }
    }
}

TEST(FluidFlows, WallsThatSlipHoldNothing)
{
    const auto left = [](Edge y) {
        const Grid grid{.cells = {8, 16, 1}, .cell_m = 0.1F, .edges = {Edge::periodic, y, Edge::no_slip}};
        Fluid fluid(test::shared_device(), grid, 0,
                    velocity_of(grid, [](glm::dvec3) { return glm::dvec3(1.0, 0.0, 0.0); }));
        return velocity_after(fluid, {.step_s = 0.05F, .viscosity_m2_s = 0.3F}, 20)[3];
    };
    EXPECT_NEAR(left(Edge::free_slip), 1.0F, 1e-5F);
    EXPECT_LT(left(Edge::no_slip), 0.5F);
}

TEST(FluidFlows, TheDirectSolverIsCheckedAtTheStart)
{
    gpu::Executor executor(test::shared_device());
    Fluid box(test::shared_device(), {.cells = {64, 32, 1}});
    const double residual = box.check_spectral(test::shared_device(), executor);
    EXPECT_GT(residual, 0.0);
    EXPECT_LT(residual, 1e-5);
    Fluid other(test::shared_device(), {.cells = {60, 32, 1}});
    EXPECT_EQ(other.check_spectral(test::shared_device(), executor), 0.0);
}

TEST(FluidFlows, WhatIsNoFluidIsRefused)
{
    gpu::Device& device = test::shared_device();
    const std::vector<float> short_start(7);
    EXPECT_THROW(Fluid(device, {.cells = {3, 8, 1}}), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 5000, 1}}), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 8, 2}}), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 8, 1}, .cell_m = 0.0F}), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 8, 1}}, 9), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 8, 1}}, 0, short_start), std::logic_error);
    EXPECT_THROW(Fluid(device, {.cells = {8, 8, 1}}, 1, {}, short_start), std::logic_error);
    Fluid fluid(device, {.cells = {8, 8, 1}});
    EXPECT_THROW(fluid.set_shapes(std::vector<Shape>(40), std::vector<Source>(25)), std::logic_error);
    gpu::Graph graph;
    EXPECT_THROW(static_cast<void>(fluid.add_steps(graph, {}, 100)), std::logic_error);
    for (const float step_s : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THROW(static_cast<void>(fluid.add_steps(graph, {.step_s = step_s}, 1)), std::logic_error);
    }
    EXPECT_THROW(static_cast<void>(fluid.add_steps(graph, {.viscosity_m2_s = 1e9F}, 1)), std::logic_error);
}

TEST(FluidFlows, StepsInOneGraphOrInManyAreTheSameBitForBit)
{
    const Grid grid{.cells = {48, 32, 1}, .edges = {Edge::periodic, Edge::free_slip, Edge::no_slip}};
    const std::vector<float> start = velocity_of(
        grid, [](glm::dvec3 p) { return glm::dvec3(std::sin(0.4 * p.y), std::cos(0.3 * p.x), 0.0); });
    const FluidStyle style{.step_s = 0.7F};
    Fluid one(test::shared_device(), grid, 0, start);
    Fluid many(test::shared_device(), grid, 0, start);
    EXPECT_EQ(velocity_after(one, style, 4), velocity_after(many, style, 4, 1));
}

/// Sums, and number of non-finite values, slice by slice in double precision.
struct Totals {
    double sum = 0.0;
    double squares = 0.0;
    bool are_finite = true;
};

Totals totals_of(const std::vector<float>& numbers)
{
    Totals totals;
    for (const float number : numbers) {
        totals.sum += static_cast<double>(number);
        totals.squares += static_cast<double>(number) * static_cast<double>(number);
        totals.are_finite = totals.are_finite && std::isfinite(number);
    }
    return totals;
}

/// Cells per side: 64, or with ESTAMPE_LONG as many as a volume may have, which takes half a minute.
uint32_t side_of_volume()
{
    return std::getenv("ESTAMPE_LONG") != nullptr ? 256 : 64;
}

TEST(FluidFlows, AVolumeTakesAStep)
{
    const uint32_t side = side_of_volume();
    const Grid grid{.cells = {side, side, side},
                    .cell_m = 1.0F / static_cast<float>(side),
                    .edges = {Edge::periodic, Edge::periodic, Edge::periodic}};
    // Tables of a sine at faces, along a component's own axis, and of a cosine at cell centres, along
    // another.
    std::vector<float> on_face(side);
    std::vector<float> in_middle(side);
    for (uint32_t i = 0; i < side; ++i) {
        on_face.at(i) = static_cast<float>(std::sin(2.0 * std::numbers::pi * i / side));
        in_middle.at(i) = static_cast<float>(std::cos(2.0 * std::numbers::pi * (i + 0.5) / side));
    }
    const auto start = over_nodes(grid, 3, [&](uint32_t component, glm::uvec3 cell) {
        const auto axis = static_cast<int>(component);
        return on_face[cell[axis]] * in_middle[cell[(axis + 1) % 3]];
    });
    const auto density = over_nodes(grid, 1, [&](uint32_t, glm::uvec3 cell) {
        return 1.0F + 0.5F * in_middle[cell.x] * in_middle[cell.y] + 0.3F * in_middle[cell.z];
    });
    Fluid fluid(test::shared_device(), grid, 1, start, density);
    const FluidStyle style{.step_s = grid.cell_m, .stepping = Stepping::project};
    const auto totals = [&](uint32_t steps, auto add) {
        gpu::Graph graph;
        return totals_of(
            test::run_and_read_as<float>(graph, add(graph, fluid.add_steps(graph, style, steps))));
    };
    const auto carried_in = [](gpu::Graph& graph, const FluidFields& fields) {
        return add_layers_copy(graph, *fields.quantities);
    };
    const Totals before = totals(1, [&](gpu::Graph& graph, const FluidFields& fields) {
        return add_divergence(graph, grid, fields.unprojected, fields.solids);
    });
    const Totals left = totals(0, [&](gpu::Graph& graph, const FluidFields& fields) {
        return add_divergence(graph, grid, fields.velocity, fields.solids);
    });
    // The first step is advected by a flow with divergence, the second by one without.
    const Totals first = totals(0, carried_in);
    const Totals carried = totals(1, carried_in);
    EXPECT_TRUE(carried.are_finite);
    EXPECT_TRUE(left.are_finite) << "nor is a speed then";
    EXPECT_GT(before.squares, 0.0);
    EXPECT_LE(std::sqrt(left.squares / before.squares), 2e-3);
    EXPECT_GT(std::abs(first.sum / totals_of(density).sum - 1.0), 1e-3);
    EXPECT_NEAR(carried.sum / first.sum, 1.0, 1e-5);
}

} // namespace
} // namespace estampe::fluid
