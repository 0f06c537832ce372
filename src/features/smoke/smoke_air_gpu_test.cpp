// SPDX-License-Identifier: MIT
// Burning and condensation with the settings of drawn smoke.
#include "features/smoke/smoke_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t air_side = 16;
constexpr double step_s = 1.0 / 24.0;

smoke::Box box_of(float width_m)
{
    const float cell_m = width_m / air_side;
    return {.cells = glm::uvec3(air_side),
            .cell_m = cell_m,
            .grid_from_anchor = glm::scale(glm::mat4(1.0F), glm::vec3(1.0F / cell_m))};
}

const smoke::Box box = box_of(2.0F);

/// No wind, outflow or cooling: all quantities stay in place.
fluid::FluidStyle closed(const smoke::SmokeStyle& style)
{
    fluid::FluidStyle solver = solving(box, style, step_s);
    solver.forces = {};
    solver.matter.rim = {};
    solver.matter.cooling_per_s = 0.0F;
    return solver;
}

std::vector<float> quantities_after(fluid::Fluid& fluid, const fluid::FluidStyle& style, uint32_t count)
{
    for (uint32_t left = count;;) {
        const uint32_t now = std::min(left, fluid.most_steps(style));
        left -= now;
        gpu::Graph graph;
        const fluid::FluidFields fields = fluid.add_steps(graph, style, now);
        const auto numbers =
            test::run_and_read_as<float>(graph, fluid::add_layers_copy(graph, *fields.quantities));
        if (left == 0) {
            return numbers;
        }
    }
}

/// The same amount of each channel in every cell.
std::vector<float> even(const std::vector<float>& amounts)
{
    std::vector<float> numbers;
    for (const float amount : amounts) {
        numbers.insert(numbers.end(), box.cells.x * box.cells.y * box.cells.z, amount);
    }
    return numbers;
}

double at(const std::vector<float>& numbers, int channel, uint32_t y)
{
    const auto of_channel = static_cast<size_t>(channel) * air_side * air_side * air_side;
    return static_cast<double>(numbers[of_channel + (size_t{5} * air_side + y) * air_side + 7]);
}

double sum_of(const std::vector<float>& numbers, int channel)
{
    const auto first = numbers.begin() + channel * static_cast<ptrdiff_t>(air_side * air_side * air_side);
    return std::accumulate(first, first + static_cast<ptrdiff_t>(air_side * air_side * air_side), 0.0);
}

TEST(SmokeAir, CarriesNoMoreThanItIsAskedFor)
{
    EXPECT_EQ(smoke_channels({}), 2U);
    EXPECT_EQ(smoke_channels({.fuel_per_s = 1.0F}), 3U);
    EXPECT_EQ(smoke_channels({.humidity = 1.0F}), 5U);
    EXPECT_EQ(smoke_channels({.fuel_per_s = 1.0F, .humidity = 1.0F}), 5U);
    EXPECT_TRUE(clean_air(box, {.fuel_per_s = 1.0F}).empty());
}

TEST(SmokeAir, WaterIsKeptAndBecomesCloudAboveItsBase)
{
    const smoke::SmokeStyle style{.humidity = 2.0F, .cloud_base = 0.4F};
    fluid::Fluid fluid(test::shared_device(), grid_of(box), 5, {}, even({0.0F, 0.0F, 0.0F, 2.0F, 0.0F}));
    const std::vector<float> end = quantities_after(fluid, closed(style), 96);
    for (uint32_t y = 0; y < air_side; ++y) {
        const double cloud = at(end, shared::fluid_cloud, y);
        EXPECT_NEAR(at(end, shared::fluid_vapour, y) + cloud, 2.0, 1e-5) << y;
        EXPECT_NEAR(at(end, shared::fluid_temperature, y), cloud, 1e-5) << "latent heat, " << y;
        const double height = (y + 0.5) / air_side;
        if (height < 0.4) {
            EXPECT_EQ(cloud, 0.0) << y;
        } else {
            EXPECT_NEAR(2.0 - cloud, 2.0 * std::exp(2.0 * (0.4 - height) + 0.25 * cloud), 2e-3) << y;
            EXPECT_GT(cloud, 0.01) << y;
        }
    }
}

TEST(SmokeAir, MovingAirKeepsItsWater)
{
    const smoke::SmokeStyle style{.humidity = 2.0F, .cloud_base = 0.3F};
    std::vector<float> start = clean_air(box, style);
    for (uint32_t i = 0; i < 4 * air_side * air_side; ++i) { // a moist layer
        start[shared::fluid_vapour * air_side * air_side * air_side + air_side * air_side * 6 + i] = 2.0F;
    }
    fluid::Fluid fluid(test::shared_device(), grid_of(box), 5, stirred_air(box, style), start);
    const double before = sum_of(start, shared::fluid_vapour);
    const std::vector<float> end = quantities_after(fluid, closed(style), 12);
    EXPECT_GT(sum_of(end, shared::fluid_cloud), 0.02 * before);
    EXPECT_NEAR((sum_of(end, shared::fluid_vapour) + sum_of(end, shared::fluid_cloud)) / before, 1.0, 0.02);
}

TEST(SmokeAir, CloudIsVapourAgainWhereItWarms)
{
    const smoke::SmokeStyle style{.humidity = 1.0F, .cloud_base = 0.0F};
    const auto cloud_at = [&](float temperature) {
        fluid::Fluid fluid(test::shared_device(), grid_of(box), 5, {},
                           even({0.0F, temperature, 0.0F, 0.5F, 0.5F}));
        return at(quantities_after(fluid, closed(style), 48), shared::fluid_cloud, 8);
    };
    EXPECT_GT(cloud_at(0.0F), 0.3);
    EXPECT_EQ(cloud_at(8.0F), 0.0);
}

TEST(SmokeAir, OutsideAirMakesNoCloud)
{
    const smoke::SmokeStyle style{.humidity = 2.0F, .cloud_base = 0.2F, .humidity_outside = 1.0F};
    fluid::Fluid fluid(test::shared_device(), grid_of(box), 5, {}, clean_air(box, style));
    const std::vector<float> end = quantities_after(fluid, solving(box, style, step_s), 24);
    EXPECT_LT(sum_of(end, shared::fluid_cloud), 1e-6 * sum_of(end, shared::fluid_vapour));
    EXPECT_NEAR(at(end, shared::fluid_vapour, 0), 2.0, 1e-5);
    EXPECT_NEAR(at(end, shared::fluid_vapour, air_side - 1), 2.0 * std::exp(2.0 * (0.2 - 15.5 / 16.0)), 1e-5);
}

/// Share of the cells of a smoke box of 32 x 32 x 32 cells in which the air turns by more than `turn_rad` in
/// a step, after three seconds.
double share_of_fast_swirls(float curl, double turn_rad)
{
    constexpr int side = 32;
    smoke::Box large = box_of(2.0F);
    large.cells = glm::uvec3(side);
    large.cell_m = 2.0F / side;
    const smoke::SmokeStyle style{.curl = curl};
    fluid::Fluid fluid(test::shared_device(), grid_of(large), 2, stirred_air(large, style));
    fluid.set_shapes({}, std::vector{source_of(large, style)});
    std::vector<float> velocity;
    for (uint32_t done = 0; done < 72; done += 4) {
        gpu::Graph graph;
        const fluid::FluidFields fields = fluid.add_steps(graph, solving(large, style, step_s), 4);
        velocity = test::run_and_read_as<float>(graph, fluid::add_layers_copy(graph, fields.velocity));
    }
    const auto speed = [&](int axis, glm::ivec3 cell) {
        cell = (cell + side) % side;
        return static_cast<double>(
            velocity[static_cast<size_t>(((axis * side + cell.z) * side + cell.y) * side + cell.x)]);
    };
    int fast = 0;
    for (int i = 0; i < side * side * side; ++i) {
        const glm::ivec3 cell(i % side, i / side % side, i / (side * side));
        double square = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const int next = (axis + 1) % 3;
            const int last = (axis + 2) % 3;
            glm::ivec3 before_next = cell;
            --before_next[next];
            glm::ivec3 before_last = cell;
            --before_last[last];
            square += std::pow(speed(last, cell) - speed(last, before_next) - speed(next, cell) +
                                   speed(next, before_last),
                               2.0);
        }
        const double turned_rad = 0.5 * std::sqrt(square) / static_cast<double>(large.cell_m) * step_s;
        fast += turned_rad > turn_rad ? 1 : 0;
    }
    return fast / std::pow(side, 3.0);
}

TEST(SmokeAir, StrongCurlFeedsNoSwirlsThatAStepCannotFollow)
{
    const double usual = share_of_fast_swirls(1.0F, 1.0);
    const double strong = share_of_fast_swirls(4.0F, 1.0);
    EXPECT_LT(usual, 0.01);
    EXPECT_LT(strong, 0.01);
    EXPECT_GT(share_of_fast_swirls(4.0F, 0.3), 1.2 * share_of_fast_swirls(1.0F, 0.3)) << "it is livelier";
}

TEST(SmokeAir, ABlastGrowsAsThingsOutsideOfTheSimulationAreTold)
{
    // Air that heat neither lifts nor leaves, so that the blast alone moves it.
    const smoke::SmokeStyle style{.amount_per_s = 0.0F,
                                  .rise_s = 100.0F,
                                  .explodes_above = 1.0F,
                                  .explosion_per_s = 10.0F,
                                  .blast_at_s = 0.0F,
                                  .blast_heat = 6.0F};
    smoke::Box large = box_of(2.0F);
    large.cells = glm::uvec3(32);
    large.cell_m = 2.0F / 32.0F;
    large.grid_from_anchor = glm::scale(glm::mat4(1.0F), glm::vec3(16.0F));
    const std::optional<Blast> blast = blast_of(large, style, {10.0, 20.0, 30.0});
    ASSERT_TRUE(blast);
    EXPECT_NEAR(blast->centre.x, 11.0, 1e-5);
    EXPECT_NEAR(blast->centre.z, 31.0, 1e-5);
    EXPECT_GT(blast->centre.y, 20.0);
    EXPECT_EQ(steps_per_s(large, style), 24.0);
    const double step = 1.0 / 48.0;
    fluid::FluidStyle solver = solving(large, style, step);
    solver.forces.lift_m_s2 = 0.0F;
    solver.forces.confinement_per_s = 0.0F;
    fluid::Fluid fluid(test::shared_device(), grid_of(large), 2);
    fluid.set_shapes({}, std::vector{blasting_source_of(large, style, step)});
    std::vector<float> hot = quantities_after(fluid, solver, 1);
    fluid.set_shapes({}, {});
    const auto heat = [&] {
        return std::accumulate(hot.begin() + 32 * 32 * 32, hot.end(), 0.0) * std::pow(2.0 / 32.0, 3.0);
    };
    EXPECT_NEAR(heat() / 6.0, blast->start_m3, 0.03 * blast->start_m3) << "the volume of the source";
    // Temperature of the middle, and with it the volume of the ball, by the law.
    for (int i = 1; i <= 24; ++i) {
        hot = quantities_after(fluid, solver, 1);
        const double hottest = static_cast<double>(*std::max_element(hot.begin() + 32 * 32 * 32, hot.end()));
        const double volume_m3 = blast->start_m3 * 6.0 / hottest;
        EXPECT_NEAR(volume_m3 / blast->volume_m3(i * step), 1.0, 0.01) << i;
    }
    EXPECT_FALSE(blast_of(large, {.explodes_above = 1.0F}, {}));
    EXPECT_FALSE(blast_of(large, {.blast_at_s = 1.0F}, {}));
    EXPECT_FALSE(blast_of(large, {.explodes_above = 41.0F, .blast_at_s = 1.0F}, {}));
    EXPECT_EQ(steps_per_s(large, {.explodes_above = 1.0F, .explosion_per_s = 30.0F}), 60.0);
}

TEST(SmokeAir, WindBlowsItOutByTheLeeSideAndNoneComesBack)
{
    const smoke::Box small = box_of(0.6F);
    const auto columns = [&](float wind_m_per_s, double steps_a_second) {
        const smoke::SmokeStyle style{.wind_m_per_s = wind_m_per_s};
        fluid::Fluid fluid(test::shared_device(), grid_of(small), 2, stirred_air(small, style));
        fluid.set_shapes({}, std::vector{source_of(small, style)});
        const std::vector<float> end = quantities_after(fluid, solving(small, style, 1.0 / steps_a_second),
                                                        static_cast<uint32_t>(1.5 * steps_a_second));
        std::array<double, air_side> amounts{}; // along x, the wind's direction
        for (uint32_t i = 0; i < air_side * air_side * air_side; ++i) {
            amounts.at(i % air_side) += static_cast<double>(end[i]);
        }
        return amounts;
    };
    const auto share = [](const std::array<double, air_side>& amounts, uint32_t first, uint32_t last) {
        return std::accumulate(amounts.begin() + first, amounts.begin() + last, 0.0) /
               std::accumulate(amounts.begin(), amounts.end(), 0.0);
    };
    EXPECT_EQ(steps_per_s(small, {}), 24.0);
    EXPECT_EQ(steps_per_s(box, {.wind_m_per_s = 2.0F}), 24.0) << "2 m wide";
    for (const float wind_m_per_s : {1.0F, 2.0F, 4.0F}) {
        const auto amounts = columns(wind_m_per_s, steps_per_s(small, {.wind_m_per_s = wind_m_per_s}));
        EXPECT_LT(share(amounts, 0, 5), 0.04) << wind_m_per_s;
        EXPECT_GT(share(amounts, 9, 14), 0.3) << wind_m_per_s;
    }
    EXPECT_GT(share(columns(4.0F, 24.0), 0, 5), 0.1) << "what longer steps do";
}

TEST(SmokeAir, NothingBurnsWithoutFuelAndWhatBurnsIsHeatAndSoot)
{
    const smoke::SmokeStyle plain;
    const smoke::SmokeStyle fire{.fuel_per_s = 6.0F};
    const auto risen = [&](const smoke::SmokeStyle& style, float fuel_per_s) {
        fluid::Fluid fluid(test::shared_device(), grid_of(box), smoke_channels(style),
                           stirred_air(box, style), clean_air(box, style));
        fluid::Source source = source_of(box, style);
        source.gain_per_s[shared::fluid_fuel] = fuel_per_s;
        fluid.set_shapes({}, std::vector{source});
        return quantities_after(fluid, solving(box, style, step_s), 24);
    };
    const std::vector<float> without = risen(plain, 0.0F);
    const std::vector<float> empty = risen(fire, 0.0F);
    EXPECT_TRUE(std::equal(without.begin(), without.end(), empty.begin())) << "to the bit";
    EXPECT_EQ(sum_of(empty, shared::fluid_fuel), 0.0);
    const std::vector<float> burnt = risen(fire, 6.0F);
    EXPECT_GT(sum_of(burnt, shared::fluid_fuel), 1.0);
    EXPECT_GT(sum_of(burnt, shared::fluid_temperature), 1.5 * sum_of(without, shared::fluid_temperature));
    EXPECT_GT(sum_of(burnt, shared::fluid_density), 1.1 * sum_of(without, shared::fluid_density));
    // In a room that is hot everywhere.
    fluid::Fluid fluid(test::shared_device(), grid_of(box), 3, {}, even({0.0F, 1.0F, 1.0F}));
    fluid::FluidStyle closed_fire = closed(fire);
    closed_fire.matter.fading_per_s = 0.0F;
    const std::vector<float> end = quantities_after(fluid, closed_fire, 24);
    const double left = at(end, shared::fluid_fuel, 3);
    EXPECT_NEAR(left, std::exp(-1.0 / 0.4), 1e-4);
    EXPECT_NEAR(at(end, shared::fluid_temperature, 3), 1.0 + (1.0 - left), 1e-4);
    EXPECT_NEAR(at(end, shared::fluid_density, 3), 0.5 * (1.0 - left), 1e-4);
}

} // namespace
} // namespace estampe::features
