// SPDX-License-Identifier: MIT
// Obstacles, sources, and changes of quantities.
#include <cstdlib>
#include <numeric>

#include <gtest/gtest.h>

#include "techniques/fluid/fluid_test_support.hpp"

namespace estampe::fluid {
namespace {

const Grid meadow{.cells = {64, 64, 1}, .cell_m = 0.1F};

struct Seen {
    std::vector<float> velocity;
    std::vector<float> quantities;
};

Seen after(Fluid& fluid, const FluidStyle& style, uint32_t steps)
{
    std::vector<float> velocity = velocity_after(fluid, style, steps);
    if (fluid.channels() == 0) {
        return {velocity, {}};
    }
    gpu::Graph graph;
    return {velocity, run_and_read_layers(graph, *fluid.add_steps(graph, style, 0).quantities)};
}

/// The same amount in every cell of each channel.
std::vector<float> even(const Grid& grid, const std::vector<float>& amounts)
{
    return over_nodes(grid, static_cast<uint32_t>(amounts.size()),
                      [&](uint32_t channel, glm::uvec3) { return amounts[channel]; });
}

double at(const std::vector<float>& numbers, const Grid& grid, uint32_t channel, uint32_t x, uint32_t y)
{
    return static_cast<double>(numbers[channel * grid.cell_count() + y * grid.cells.x + x]);
}

double sum_of_channel(const std::vector<float>& numbers, const Grid& grid, uint32_t channel)
{
    const auto first = numbers.begin() + static_cast<ptrdiff_t>(channel * grid.cell_count());
    return std::accumulate(first, first + static_cast<ptrdiff_t>(grid.cell_count()), 0.0);
}

/// Divergence after the last projection of `steps` steps, relative to the divergence before this projection.
double divergence_left(Fluid& fluid, const FluidStyle& style, uint32_t steps)
{
    static_cast<void>(velocity_after(fluid, style, steps));
    const auto left = [&](bool is_after) {
        gpu::Graph graph;
        const FluidFields fields = fluid.add_steps(graph, style, is_after ? 0 : 1);
        return norm(test::run_and_read_as<float>(
            graph, add_divergence(graph, fluid.grid(), is_after ? fields.velocity : fields.unprojected,
                                  fields.solids)));
    };
    const double before = left(false);
    return left(true) / before;
}

std::vector<Shape> walkers()
{
    Shape ball = disc({2.0F, 3.0F, 0.0F}, 0.6F);
    ball.velocity_m_per_s = {1.0F, 0.4F, 0.0F};
    Shape oar = box({4.4F, 3.2F, 0.0F}, {0.9F, 0.15F, 0.0F}, 0.5F);
    oar.spin_rad_s = 2.0F;
    Shape pill = capsule({3.0F, 5.0F, 0.0F}, 1.0F, 0.3F);
    pill.velocity_m_per_s = {0.0F, -0.7F, 0.0F};
    return {ball, oar, pill};
}

TEST(FluidMatter, MovingObstaclesLeaveLittleDivergence)
{
    Fluid fluid(test::shared_device(), meadow);
    fluid.set_shapes(walkers(), {});
    EXPECT_LE(divergence_left(fluid, {.step_s = 0.02F}, 20), 2e-3);
}

TEST(FluidMatter, ObstaclesMoveInVolumesToo)
{
    const Grid room{.cells = {24, 24, 24}, .cell_m = 0.1F};
    Fluid fluid(test::shared_device(), room);
    Shape ball = disc({1.2F, 1.2F, 1.2F}, 0.5F);
    ball.velocity_m_per_s = {0.3F, 0.2F, 0.5F};
    fluid.set_shapes(std::vector{ball}, {});
    EXPECT_LE(divergence_left(fluid, {.step_s = 0.05F}, 2), 2e-3);
}

TEST(FluidMatter, FacesOfObstaclesMoveAsTheyDo)
{
    Fluid fluid(test::shared_device(), meadow);
    Shape oar = box({3.2F, 3.2F, 0.0F}, {1.0F, 0.4F, 0.0F});
    oar.spin_rad_s = 1.5F;
    oar.velocity_m_per_s = {0.0F, 0.25F, 0.0F};
    fluid.set_shapes(std::vector{oar}, {});
    const std::vector<float> velocity = after(fluid, {.step_s = 0.001F}, 1).velocity;
    // Inside the obstacle, one step later.
    EXPECT_NEAR(at(velocity, meadow, 0, 32, 30), -1.5 * (3.05 - 3.2), 2e-3);
    EXPECT_NEAR(at(velocity, meadow, 1, 38, 32), 0.25 + 1.5 * (3.85 - 3.2), 2e-3);
    // Fluid in front of the obstacle is pushed away, fluid behind it follows.
    EXPECT_GT(at(velocity, meadow, 1, 41, 38), 0.05);
    EXPECT_GT(norm(velocity), 1.0);
}

TEST(FluidMatter, ObstaclesGoOnFromGraphToGraph)
{
    Fluid fluid(test::shared_device(), meadow);
    Shape ball = disc({2.05F, 3.2F, 0.0F}, 0.4F);
    ball.velocity_m_per_s = {1.0F, 0.0F, 0.0F};
    fluid.set_shapes(std::vector{ball}, {});
    const std::vector<float> velocity = velocity_after(fluid, {.step_s = 0.05F}, 20, 3);
    for (uint32_t x = 28; x <= 33; ++x) {
        EXPECT_EQ(at(velocity, meadow, 0, x, 32), 1.0) << x;
    }
    EXPECT_NE(at(velocity, meadow, 0, 24, 32), 1.0);
    EXPECT_NE(at(velocity, meadow, 0, 37, 32), 1.0);
}

TEST(FluidMatter, SourcesBringWhatTheySay)
{
    Fluid fluid(test::shared_device(), meadow, 5);
    Source source{.shape = disc({3.2F, 3.2F, 0.0F}, 1.0F), .push_per_s = 20.0F};
    source.shape.velocity_m_per_s = {0.0F, 0.0F, 0.0F};
    source.gain_per_s = {0.5F, 2.0F, 0.0F, 0.0F, 3.0F};
    fluid.set_shapes({}, std::vector{source});
    const Seen seen = after(fluid, {.step_s = 0.02F}, 25);
    const double cells = std::numbers::pi * 1.0 / (0.1 * 0.1);
    EXPECT_NEAR(sum_of_channel(seen.quantities, meadow, 0) / (0.25 * cells), 1.0, 0.01);
    EXPECT_NEAR(sum_of_channel(seen.quantities, meadow, 1) / (1.0 * cells), 1.0, 0.01);
    EXPECT_EQ(sum_of_channel(seen.quantities, meadow, 2), 0.0);
    EXPECT_NEAR(at(seen.quantities, meadow, 4, 32, 32), 1.5, 1e-4);
}

TEST(FluidMatter, SourcesAreAsDenseInAQuickStreamAsTheySay)
{
    constexpr Edge open = Edge::periodic;
    const Grid stream{.cells = {64, 64, 1}, .cell_m = 0.1F, .edges = {open, open, open}};
    const auto upwards =
        over_nodes(stream, 2, [](uint32_t axis, glm::uvec3) { return axis == 1 ? 8.0 : 0.0; });
    Fluid fluid(test::shared_device(), stream, 2, upwards);
    Source source{.shape = disc({3.2F, 0.4F, 0.0F}, 0.7F)};
    source.gain_per_s = {1.0F};
    source.least_density = 0.6F;
    fluid.set_shapes({}, std::vector{source});
    FluidStyle style{.step_s = 0.02F};
    style.matter.rim = {.breadth_m = 0.8F, .share_per_s = 20.0F};
    style.matter.fading_per_s = 2.0F;
    const std::vector<float> quantities = after(fluid, style, 10).quantities;
    for (uint32_t y = 0; y < 10; ++y) {
        EXPECT_GE(at(quantities, stream, 0, 32, y), 0.6 - 1e-6) << y;
    }
    EXPECT_EQ(at(quantities, stream, 1, 32, 4), 0.0) << "of no other quantity";
    EXPECT_EQ(at(quantities, stream, 0, 10, 4), 0.0);
}

TEST(FluidMatter, HeatRisesAndWeightFalls)
{
    const auto blob = over_nodes(meadow, 2, [](uint32_t channel, glm::uvec3 cell) {
        return channel == 1 && glm::distance(glm::dvec2(glm::uvec2(cell)), glm::dvec2(31.5)) < 8.0 ? 1.0
                                                                                                   : 0.0;
    });
    const auto height_of = [&](const std::vector<float>& quantities) {
        double moment = 0.0;
        for (uint32_t y = 0; y < 64; ++y) {
            for (uint32_t x = 0; x < 64; ++x) {
                moment += y * at(quantities, meadow, 1, x, y);
            }
        }
        return moment / sum_of_channel(quantities, meadow, 1);
    };
    const FluidStyle warm{.step_s = 0.02F, .forces = {.lift_m_s2 = 2.0F}};
    Fluid rising(test::shared_device(), meadow, 2, {}, blob);
    const Seen risen = after(rising, warm, 40);
    EXPECT_GT(height_of(risen.quantities), 31.5 + 1.5);
    // With gravity reversed, density acts in the same way.
    std::vector<float> heavy(blob.begin() + static_cast<ptrdiff_t>(meadow.cell_count()), blob.end());
    heavy.resize(2 * meadow.cell_count());
    Fluid falling(test::shared_device(), meadow, 2, {}, heavy);
    const Seen fallen = after(falling, {.step_s = 0.02F, .forces = {.weight_m_s2 = 2.0F}}, 40);
    for (uint32_t i = 0; i < 64; i += 5) {
        EXPECT_NEAR(at(fallen.quantities, meadow, 0, i, 20), at(risen.quantities, meadow, 1, i, 43), 2e-3)
            << i;
    }
}

TEST(FluidMatter, EvenQuantitiesStayEvenHoweverTheFlowRuns)
{
    Fluid fluid(test::shared_device(), meadow, 3, {}, even(meadow, {0.25F, -3.0F, 7.0F}));
    Source push{.shape = disc({2.0F, 2.5F, 0.0F}, 0.5F), .push_per_s = 10.0F};
    push.shape.velocity_m_per_s = {2.0F, 1.0F, 0.0F};
    fluid.set_shapes({}, std::vector{push});
    const Seen seen = after(fluid, {.step_s = 0.05F}, 10);
    EXPECT_GT(norm(seen.velocity), 5.0);
    for (uint32_t channel = 0; channel < 3; ++channel) {
        const double amount = std::array{0.25, -3.0, 7.0}[channel];
        EXPECT_NEAR(at(seen.quantities, meadow, channel, 20, 25), amount, 1e-5 * std::abs(amount));
    }
}

TEST(FluidMatter, FrictionAndFadingAreExponential)
{
    const Grid loop{.cells = {16, 16, 1}, .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    Fluid fluid(test::shared_device(), loop, 2,
                velocity_of(loop, [](glm::dvec3) { return glm::dvec3(2.0, -1.0, 0.0); }),
                even(loop, {1.0F, 4.0F}));
    const Seen seen = after(fluid,
                            {.step_s = 0.1F,
                             .forces = {.friction_per_s = 0.5F},
                             .matter = {.fading_per_s = 0.3F, .cooling_per_s = 0.9F}},
                            10);
    EXPECT_NEAR(at(seen.velocity, loop, 0, 3, 4), 2.0 * std::exp(-0.5), 1e-4);
    EXPECT_NEAR(at(seen.velocity, loop, 1, 3, 4), -1.0 * std::exp(-0.5), 1e-4);
    EXPECT_NEAR(at(seen.quantities, loop, 0, 3, 4), std::exp(-0.3), 1e-5);
    EXPECT_NEAR(at(seen.quantities, loop, 1, 3, 4), 4.0 * std::exp(-0.9), 1e-5);
}

TEST(FluidMatter, FuelBurnsWhereItIsHotIntoHeatAndSmoke)
{
    const MatterStyle fire{
        .burning_per_s = 2.0F, .ignition = 0.5F, .heat_of_fuel = 3.0F, .smoke_of_fuel = 0.7F};
    const auto burnt = [&](float temperature) {
        Fluid fluid(test::shared_device(), meadow, 3, {}, even(meadow, {0.0F, temperature, 1.0F}));
        return after(fluid, {.step_s = 0.05F, .matter = fire}, 10).quantities;
    };
    const std::vector<float> cold = burnt(0.4F);
    EXPECT_EQ(at(cold, meadow, 2, 9, 9), 1.0);
    const std::vector<float> hot = burnt(0.6F);
    const double left = at(hot, meadow, 2, 9, 9);
    EXPECT_NEAR(left, std::exp(-1.0), 1e-4);
    EXPECT_NEAR(at(hot, meadow, 1, 9, 9), 0.6 + 3.0 * (1.0 - left), 1e-4);
    EXPECT_NEAR(at(hot, meadow, 0, 9, 9), 0.7 * (1.0 - left), 1e-4);
}

TEST(FluidMatter, VapourCondensesToWhatAirHoldsAndKeepsItsHeat)
{
    const MatterStyle sky{.condensing_per_s = 8.0F,
                          .saturation = 1.0F,
                          .saturation_growth = 0.2F,
                          .saturation_fall_per_m = 0.1F,
                          .latent_heat = 1.5F};
    const auto settled = [&](float vapour, float cloud) {
        Fluid fluid(test::shared_device(), meadow, 5, {}, even(meadow, {0.0F, 0.0F, 0.0F, vapour, cloud}));
        return after(fluid, {.step_s = 0.05F, .matter = sky}, 60).quantities;
    };
    for (const auto& [vapour, cloud] :
         {std::pair(2.0F, 0.0F), std::pair(0.3F, 0.9F), std::pair(0.2F, 0.1F)}) {
        const std::vector<float> end = settled(vapour, cloud);
        for (const uint32_t y : {2U, 60U}) {
            const double heat = at(end, meadow, 1, 5, y);
            const double vapour_left = at(end, meadow, 3, 5, y);
            const double cloud_left = at(end, meadow, 4, 5, y);
            EXPECT_NEAR(vapour_left + cloud_left, static_cast<double>(vapour + cloud), 1e-5);
            EXPECT_NEAR(heat, 1.5 * (cloud_left - static_cast<double>(cloud)), 1e-5);
            const double holds = std::exp(0.2 * heat - 0.1 * (y + 0.5) * 0.1);
            if (cloud_left > 1e-3) {
                EXPECT_NEAR(vapour_left, holds, 1e-3) << y;
            } else {
                EXPECT_LT(vapour_left, holds) << y;
            }
        }
    }
}

TEST(FluidMatter, ConfinementFeedsVortices)
{
    const Grid loop{.cells = {64, 64, 1}, .edges = {Edge::periodic, Edge::periodic, Edge::no_slip}};
    const auto start = velocity_of(loop, [](glm::dvec3 p) {
        const glm::dvec2 off = (glm::dvec2(p) - 32.0) / 6.0;
        return std::exp(-glm::dot(off, off)) * glm::dvec3(-off.y, off.x, 0.0);
    });
    const auto energy = [&](float confinement, Advection advection) {
        Fluid fluid(test::shared_device(), loop, 0, start);
        return norm(after(fluid,
                          {.step_s = 1.0F,
                           .velocity_advection = advection,
                           .forces = {.confinement_per_s = confinement}},
                          20)
                        .velocity) /
               norm(start);
    };
    // A weak force, and cubic advection without other losses: the difference is the work of the force.
    const double gained = energy(0.01F, Advection::cubic) - energy(0.0F, Advection::cubic);
    EXPECT_GT(gained, 0.03);
    EXPECT_LT(gained, 0.5);
    EXPECT_NEAR(energy(0.0F, Advection::cubic) - energy(-0.01F, Advection::cubic), gained, 0.5 * gained);
}

/// All effects at once: fire, clouds, friction, vorticity confinement.
FluidStyle all_that_stirs()
{
    return {.step_s = 0.5F,
            .projection = {.projections = 1},
            .forces = {.friction_per_s = 0.05F,
                       .lift_m_s2 = 0.5F,
                       .weight_m_s2 = 0.3F,
                       .confinement_per_s = 0.1F},
            .matter = {.fading_per_s = 0.1F,
                       .cooling_per_s = 0.2F,
                       .burning_per_s = 0.5F,
                       .ignition = 0.5F,
                       .condensing_per_s = 1.0F,
                       .saturation_growth = 0.1F,
                       .latent_heat = 0.3F}};
}

/// Stirs a box of 3.2 m per side at random, with sources and obstacles that change every 4 seconds. The
/// result must stay finite and no faster than the sources can make it.
void stir(const Grid& grid, uint32_t seconds)
{
    Fluid fluid(test::shared_device(), grid, 5, {}, even(grid, {0.1F, 0.0F, 0.2F, 1.0F, 0.0F}));
    std::mt19937 random(3);
    const auto any = [&](double low, double high) {
        return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
    };
    const auto anywhere = [&](double low, double high) {
        const float x = any(low, high);
        const float y = any(low, high);
        return glm::vec3(x, y, grid.is_volume() ? any(low, high) : 0.0F);
    };
    constexpr uint32_t stir_s = 4;
    const auto finite = [](float number) { return std::isfinite(number); };
    double fastest = 0.0;
    for (uint32_t i = 0; i < seconds / stir_s; ++i) {
        Source spoon{.shape = disc(anywhere(0.0, 3.2), any(0.1, 0.5)), .push_per_s = 10.0F};
        spoon.shape.velocity_m_per_s = anywhere(-3.0, 3.0);
        spoon.gain_per_s = {any(0.0, 1.0), any(-1.0, 2.0), any(0.0, 1.0), any(0.0, 1.0), 0.0F};
        Shape stone = disc(anywhere(0.0, 3.2), any(0.1, 0.5));
        stone.velocity_m_per_s = anywhere(-1.0, 1.0);
        // Removes the obstacle at times, so that the solver changes.
        fluid.set_shapes(i % 3 == 0 ? std::vector{stone} : std::vector<Shape>{}, std::vector{spoon});
        const std::vector<float> speeds = velocity_after(fluid, all_that_stirs(), 2 * stir_s);
        ASSERT_TRUE(std::ranges::all_of(speeds, finite)) << "after " << (i + 1) * stir_s << " s";
        for (const float speed : speeds) {
            fastest = std::max(fastest, static_cast<double>(std::abs(speed)));
        }
    }
    EXPECT_GT(fastest, 1.0);
    EXPECT_LT(fastest, 12.0);
    gpu::Graph graph;
    for (const float amount :
         run_and_read_layers(graph, *fluid.add_steps(graph, all_that_stirs(), 0).quantities)) {
        ASSERT_TRUE(std::isfinite(amount) && std::abs(amount) < 1e4F);
    }
}

TEST(FluidMatter, TenMinutesOfStirringDoNotBlowUp)
{
    stir({.cells = {32, 32, 1}, .cell_m = 0.1F}, 600);
}

TEST(FluidMatter, StirredVolumesDoNotBlowUp)
{
    // A few seconds, or ten minutes with finer cells.
    if (std::getenv("ESTAMPE_LONG") != nullptr) {
        stir({.cells = {32, 32, 32}, .cell_m = 0.1F}, 600);
    } else {
        stir({.cells = {16, 16, 16}, .cell_m = 0.2F}, 24);
    }
}

} // namespace
} // namespace estampe::fluid
