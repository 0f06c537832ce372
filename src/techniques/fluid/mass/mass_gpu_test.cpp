// SPDX-License-Identifier: MIT
// Checks that no unit of mass is lost or created, and that plain advection does lose mass.
#include "techniques/fluid/mass/mass.hpp"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "techniques/fluid/fluid_test_support.hpp"

namespace estampe::fluid {
namespace {

/// A flow with divergence and vortices, at rest at walls.
glm::dvec3 stirred_flow(glm::dvec3 p)
{
    const double x = 2.0 * std::numbers::pi * p.x / 32.0;
    const double y = 2.0 * std::numbers::pi * p.y / 32.0;
    return {std::sin(x) * (1.0 + std::cos(2.0 * y)),
            0.8 * std::sin(y) * std::cos(x) + 0.3 * std::sin(2.0 * y), 0.0};
}

std::vector<float> lumps(const Grid& grid)
{
    return over_nodes(
        grid, 1, [](uint32_t, glm::uvec3 cell) { return (cell.x * 7 + cell.y * 13) % 5 == 0 ? 2.3 : 0.01; });
}

struct Carrying {
    Carrying(const Grid& of, const Flow& flow, std::span<const float> mass)
        : grid(of), fluid(test::shared_device(), of, 0, velocity_of(of, flow)),
          field(test::shared_device(), of, mass)
    {
    }

    /// Mass per cell in units, after `steps` more steps of a constant flow.
    std::vector<uint32_t> after(MassAdvection advection, uint32_t steps, float step_s)
    {
        constexpr uint32_t at_once = 30;
        for (;;) {
            const uint32_t now = std::min(steps, at_once);
            steps -= now;
            gpu::Graph graph;
            const gpu::ImageId velocity = fluid.add_steps(graph, {}, 0).velocity;
            gpu::BufferId mass = field.import(graph);
            for (uint32_t i = 0; i < now; ++i) {
                mass = add_mass_step(graph, grid, mass, {velocity, step_s, advection});
            }
            if (now > 0) {
                field.keep(graph, mass);
            }
            auto units = test::run_and_read_as<uint32_t>(graph, mass);
            if (steps == 0) {
                return units;
            }
        }
    }

    Grid grid;
    Fluid fluid;
    MassField field;
};

uint64_t sum_of_units(const std::vector<uint32_t>& units)
{
    return std::accumulate(units.begin(), units.end(), uint64_t{0});
}

TEST(FluidMass, IsKeptToTheUnitInTenThousandStepsAndNeverNegative)
{
    const Grid grid{.cells = {32, 32, 1}, .edges = {Edge::no_slip, Edge::periodic, Edge::no_slip}};
    for (const MassAdvection advection : {MassAdvection::forward, MassAdvection::both_ways}) {
        Carrying carrying(grid, stirred_flow, lumps(grid));
        const uint64_t before = sum_of_units(carrying.after(advection, 0, 0.0F));
        EXPECT_GT(before, 0U);
        for (const float step_s : {0.9F, 6.1F}) {
            const std::vector<uint32_t> units =
                carrying.after(advection, advection == MassAdvection::forward ? 200 : 5000, step_s);
            ASSERT_EQ(sum_of_units(units), before);
            // A negative count would wrap to a huge number.
            ASSERT_LE(*std::max_element(units.begin(), units.end()), before);
        }
    }
}

TEST(FluidMass, PlainAdvectionLosesOrMakesIt)
{
    const Grid grid{.cells = {32, 32, 1}, .edges = {Edge::no_slip, Edge::periodic, Edge::no_slip}};
    const std::vector<float> start = lumps(grid);
    Fluid fluid(test::shared_device(), grid, 1, velocity_of(grid, stirred_flow), start);
    gpu::Graph graph;
    const FluidFields fields =
        fluid.add_steps(graph, {.step_s = 0.9F, .quantity_advection = Advection::linear}, 2);
    const std::vector<float> end = run_and_read_layers(graph, *fields.quantities);
    const auto sum = [](const std::vector<float>& numbers, size_t count) {
        return std::accumulate(numbers.begin(), numbers.begin() + static_cast<ptrdiff_t>(count), 0.0);
    };
    EXPECT_GT(std::abs(sum(end, start.size()) / sum(start, start.size()) - 1.0), 1e-3);
}

TEST(FluidMass, EvenMassInAnEvenFlowStaysEven)
{
    const Grid grid{.cells = {24, 16, 1}, .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    const std::vector<float> even(grid.cell_count(), 0.37F);
    for (const MassAdvection advection : {MassAdvection::forward, MassAdvection::both_ways}) {
        Carrying carrying(
            grid, [](glm::dvec3) { return glm::dvec3(0.713, -1.9, 0.0); }, even);
        const std::vector<uint32_t> before = carrying.after(advection, 0, 0.0F);
        EXPECT_EQ(carrying.after(advection, 50, 1.3F), before);
    }
}

TEST(FluidMass, MovesAsFarAsTheFlow)
{
    const Grid grid{.cells = {64, 8, 1}, .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    const std::vector<float> start = over_nodes(
        grid, 1, [](uint32_t, glm::uvec3 cell) { return std::exp(-std::pow((cell.x - 16.0) / 4.0, 2.0)); });
    for (const MassAdvection advection : {MassAdvection::forward, MassAdvection::both_ways}) {
        Carrying carrying(
            grid, [](glm::dvec3) { return glm::dvec3(1.0, 0.0, 0.0); }, start);
        const std::vector<uint32_t> units = carrying.after(advection, 40, 0.55F);
        double moment = 0.0;
        for (size_t i = 0; i < units.size(); ++i) {
            moment += static_cast<double>(units[i]) * static_cast<double>(i % 64);
        }
        EXPECT_NEAR(moment / static_cast<double>(sum_of_units(units)), 16.0 + 22.0, 0.02);
    }
}

/// Mean square distance along x that a small pulse has spread after `steps` steps of add_spread().
double pulse_spread(float stiffness, uint32_t steps, float step_s)
{
    const Grid grid{.cells = {128, 4, 1}, .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    const std::vector<float> start = over_nodes(grid, 1, [](uint32_t, glm::uvec3 cell) {
        return 1.0 + 0.02 * std::exp(-std::pow((cell.x - 64.0) / 5.0, 2.0));
    });
    Fluid still(test::shared_device(), grid);
    MassField field(test::shared_device(), grid, start);
    gpu::Graph graph;
    gpu::ImageId velocity = still.add_steps(graph, {}, 0).velocity;
    gpu::BufferId mass = field.import(graph);
    for (uint32_t i = 0; i < steps; ++i) {
        velocity = add_spread(graph, grid,
                              {.mass = mass,
                               .velocity = velocity,
                               .target = graph.image("spread", velocity_desc(grid)),
                               .stiffness_m2_s2 = stiffness,
                               .time_s = step_s});
        mass = add_mass_step(graph, grid, mass, {velocity, step_s});
    }
    const auto units = test::run_and_read_as<uint32_t>(graph, mass);
    double moment = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < units.size(); ++i) {
        const double more = static_cast<double>(units[i]) / shared::fluid_mass_unit - 1.0;
        moment += more * std::pow(static_cast<double>(i % 128) - 64.0, 2.0);
        sum += more;
    }
    return moment / sum;
}

TEST(FluidMass, PulsesRunAsFastAsSound)
{
    // The pulse splits into two halves that move apart, so the mean square grows with the square of the
    // distance.
    for (const float stiffness : {1.0F, 4.0F}) {
        const double step = 0.4;
        const auto step_s = static_cast<float>(step / std::sqrt(static_cast<double>(stiffness)));
        const double grown = pulse_spread(stiffness, 30, step_s) - pulse_spread(stiffness, 10, step_s);
        const double way = std::sqrt(grown / (30.0 * 30.0 - 10.0 * 10.0));
        EXPECT_NEAR(way / step, 1.0, 0.05) << stiffness;
    }
}

std::vector<double> sums_of_channels(const Grid& grid, const std::vector<float>& quantities)
{
    std::vector<double> sums;
    for (size_t first = 0; first < quantities.size(); first += grid.cell_count()) {
        const auto begin = quantities.begin() + static_cast<ptrdiff_t>(first);
        sums.push_back(std::accumulate(begin, begin + static_cast<ptrdiff_t>(grid.cell_count()), 0.0));
    }
    return sums;
}

/// Quantities in whole units: lumps of density, and a temperature that is negative in places.
std::vector<float> lumps_and_warmth(const Grid& grid)
{
    return over_nodes(grid, 2, [](uint32_t channel, glm::uvec3 cell) {
        const bool is_lump = (cell.x * 7 + cell.y * 13 + cell.z * 5) % 5 == 0;
        return channel == 0 ? (is_lump ? 2.25 : 0.015625) : (is_lump ? -1.5 : 0.75);
    });
}

TEST(FluidMass, AFluidSolvedByItKeepsEachQuantityToTheUnit)
{
    for (const glm::uvec3 cells : {glm::uvec3(32, 32, 1), glm::uvec3(16, 16, 8)}) {
        const Grid grid{.cells = cells, .edges = {Edge::no_slip, Edge::periodic, Edge::no_slip}};
        const std::vector<float> start = lumps_and_warmth(grid);
        const auto sums_after = [&](Solver solver) {
            const FluidStyle style{.step_s = 0.5F,
                                   .stepping = Stepping::project,
                                   .projection = {.solver = solver, .jacobi_rounds = 20}};
            Fluid fluid(test::shared_device(), grid, 2, velocity_of(grid, stirred_flow), start);
            fluid.ensure_mass(test::shared_device(), style);
            for (uint32_t done = 0;;) {
                const uint32_t now = std::min(12 - done, fluid.most_steps(style));
                done += now;
                gpu::Graph graph;
                const FluidFields fields = fluid.add_steps(graph, style, now);
                const std::vector<float> quantities = run_and_read_layers(graph, *fields.quantities);
                if (done == 12) {
                    return sums_of_channels(grid, quantities);
                }
            }
        };
        EXPECT_EQ(sums_after(Solver::mass), sums_of_channels(grid, start));
        EXPECT_GT(std::abs(sums_after(Solver::jacobi).front() / sums_of_channels(grid, start).front() - 1.0),
                  1e-4);
    }
}

TEST(FluidMass, AFluidSolvedByItDecaysAsTaylorAndGreenComputed)
{
    constexpr double tau = 2.0 * std::numbers::pi;
    constexpr double viscosity = 0.01;
    const Grid grid{.cells = {64, 64, 1},
                    .cell_m = static_cast<float>(tau / 64.0),
                    .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    Fluid fluid(test::shared_device(), grid, 0, velocity_of(grid, [](glm::dvec3 p) {
                    return glm::dvec3(std::sin(p.x) * std::cos(p.y), -std::cos(p.x) * std::sin(p.y), 0.0);
                }));
    const FluidStyle style{.step_s = static_cast<float>(tau / 200.0),
                           .stepping = Stepping::project,
                           .projection = {.solver = Solver::mass},
                           .viscosity_m2_s = static_cast<float>(viscosity)};
    fluid.ensure_mass(test::shared_device(), style);
    const double before = norm(velocity_after(fluid, style, 0));
    const double after = norm(velocity_after(fluid, style, 200));
    EXPECT_NEAR(std::pow(after / before, 2.0), std::exp(-4.0 * viscosity * tau), 0.03);
    // The mass stays near 1: the fluid is nearly incompressible.
    gpu::Graph graph;
    const FluidFields fields = fluid.add_steps(graph, style, 0);
    const auto units = test::run_and_read_as<uint32_t>(graph, fields.mass.value());
    const auto [least, most] = std::ranges::minmax_element(units);
    EXPECT_GT(*least, 0.97 * shared::fluid_mass_unit);
    EXPECT_LT(*most, 1.03 * shared::fluid_mass_unit);
    EXPECT_EQ(sum_of_units(units), grid.cell_count() * shared::fluid_mass_unit);
}

TEST(FluidMass, AFluidWithoutItHasNoSolverByIt)
{
    Fluid fluid(test::shared_device(), {.cells = {8, 8, 1}});
    gpu::Graph graph;
    EXPECT_THROW(static_cast<void>(fluid.add_steps(graph, {.projection = {.solver = Solver::mass}}, 1)),
                 std::logic_error);
    EXPECT_THROW(fluid.set_mass(test::shared_device(), std::vector<float>(63, 1.0F)), std::logic_error);
}

TEST(FluidMass, StartsAreChecked)
{
    const Grid grid{.cells = {8, 8, 1}};
    std::vector<float> mass(64, 1.0F);
    for (const float wrong : {-1.0F, 40000.0F, std::numeric_limits<float>::quiet_NaN()}) {
        mass[5] = wrong;
        EXPECT_THROW(MassField(test::shared_device(), grid, mass), std::logic_error);
    }
    mass.resize(63);
    EXPECT_THROW(MassField(test::shared_device(), grid, mass), std::logic_error);
}

} // namespace
} // namespace estampe::fluid
