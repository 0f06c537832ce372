// SPDX-License-Identifier: MIT
// Fluid features that smoke in a box needs: open ends, permanently solid cells, vorticity confinement in
// volumes.
#include <gtest/gtest.h>

#include "techniques/fluid/fluid_test_support.hpp"

namespace estampe::fluid {
namespace {

constexpr uint32_t box_side = 16;

Grid room(Edge edge)
{
    return {.cells = {box_side, box_side, box_side}, .cell_m = 0.1F, .edges = {edge, edge, edge}};
}

float number_at(const std::vector<float>& numbers, uint32_t channel, glm::uvec3 cell)
{
    return numbers[((channel * box_side + cell.z) * box_side + cell.y) * box_side + cell.x];
}

double energy(std::span<const float> velocity)
{
    double sum = 0.0;
    for (const float speed : velocity) {
        sum += static_cast<double>(speed) * static_cast<double>(speed);
    }
    return sum;
}

TEST(FluidBox, SmokeLeavesAtOpenEndsButNotThroughTheFloor)
{
    const Grid grid = room(Edge::periodic);
    const auto density = over_nodes(grid, 1, [](uint32_t, glm::uvec3) { return 1.0F; });
    Fluid fluid(test::shared_device(), grid, 1, {}, density);
    FluidStyle style{.step_s = 0.05F, .stepping = Stepping::project};
    style.matter.rim = {.breadth_m = 0.4F, .share_per_s = 3.0F};
    static_cast<void>(velocity_after(fluid, style, 4));
    gpu::Graph graph;
    const auto left = run_and_read_layers(graph, *fluid.add_steps(graph, style, 0).quantities);
    const auto expected = [](double cells_inside) {
        const double share = (1.0 - std::exp(-3.0 * 0.05)) * std::max(1.0 - cells_inside / 4.0, 0.0);
        return std::pow(1.0 - share, 4.0);
    };
    EXPECT_NEAR(number_at(left, 0, {8, 8, 8}), 1.0, 1e-6);
    EXPECT_NEAR(number_at(left, 0, {8, 0, 8}), 1.0, 1e-6) << "the floor";
    EXPECT_NEAR(number_at(left, 0, {8, 15, 8}), expected(0.5), 1e-5);
    EXPECT_NEAR(number_at(left, 0, {1, 8, 8}), expected(1.5), 1e-5);
    EXPECT_NEAR(number_at(left, 0, {8, 8, 13}), expected(2.5), 1e-5);
}

TEST(FluidBox, FuelAndCloudLeaveAtOpenEndsAndOutsideAirBringsItsVapour)
{
    const Grid grid = room(Edge::periodic);
    const auto start = over_nodes(grid, 5, [](uint32_t channel, glm::uvec3) {
        return std::array{1.0, 0.0, 0.8, 0.1, 0.6}[channel];
    });
    Fluid fluid(test::shared_device(), grid, 5, {}, start);
    FluidStyle style{.step_s = 0.05F, .stepping = Stepping::project};
    style.matter.rim = {.breadth_m = 0.4F, .share_per_s = 3.0F};
    style.matter.saturation = 1.0F;
    style.matter.saturation_fall_per_m = 1.0F;
    style.matter.outside_vapour = 0.5F;
    static_cast<void>(velocity_after(fluid, style, 4));
    gpu::Graph graph;
    const auto left = run_and_read_layers(graph, *fluid.add_steps(graph, style, 0).quantities);
    const auto stays = [](double cells_inside) {
        return std::pow(1.0 - (1.0 - std::exp(-3.0 * 0.05)) * (1.0 - cells_inside / 4.0), 4.0);
    };
    EXPECT_NEAR(number_at(left, 2, {8, 15, 8}), 0.8 * stays(0.5), 1e-5);
    EXPECT_NEAR(number_at(left, 4, {1, 8, 8}), 0.6 * stays(1.5), 1e-5);
    EXPECT_NEAR(number_at(left, 3, {1, 4, 8}), 0.5 - 0.4 * stays(1.5), 1e-5);
    // At greater heights, the outside air holds at most this much vapour.
    const double held = std::exp(-1.55);
    EXPECT_NEAR(number_at(left, 3, {8, 15, 8}), held + (0.1 - held) * stays(0.5), 1e-5);
    for (const uint32_t channel : {2U, 3U, 4U}) {
        EXPECT_EQ(number_at(left, channel, {8, 0, 8}), start[channel * grid.cell_count()]) << "the floor";
    }
}

TEST(FluidBox, AirAtOpenEndsTakesUpTheWind)
{
    const Grid grid = room(Edge::periodic);
    Fluid fluid(test::shared_device(), grid);
    FluidStyle style{.step_s = 0.05F, .stepping = Stepping::project};
    style.forces.rim = {.breadth_m = 0.4F, .share_per_s = 10.0F};
    style.forces.outside_m_per_s = {0.8F, 0.0F, 0.3F};
    const auto velocity = velocity_after(fluid, style, 40);
    EXPECT_NEAR(number_at(velocity, 0, {8, 15, 8}), 0.8F, 0.05F);
    EXPECT_NEAR(number_at(velocity, 2, {8, 15, 8}), 0.3F, 0.05F);
    EXPECT_NEAR(number_at(velocity, 1, {8, 15, 8}), 0.0F, 0.05F);
}

TEST(FluidBox, WhatStandsIsAnObstacleLikeAnyOther)
{
    const Grid grid = room(Edge::free_slip);
    const Flow breeze = [](glm::dvec3 place) {
        return glm::dvec3(std::sin(3.0 * place.y), 0.2, std::cos(2.0 * place.x));
    };
    FluidStyle style{.step_s = 0.05F, .stepping = Stepping::project};
    const auto start = velocity_of(grid, breeze);
    Fluid by_shape(test::shared_device(), grid, 0, start);
    by_shape.set_shapes(std::vector{box({0.8F, 0.6F, 0.7F}, {0.2F, 0.3F, 0.1F})}, {});
    std::vector<uint8_t> cells;
    for (uint32_t i = 0; i < grid.cell_count(); ++i) {
        const glm::uvec3 cell(i % box_side, i / box_side % box_side, i / (box_side * box_side));
        const bool is_in = glm::all(glm::greaterThanEqual(cell, glm::uvec3(6, 3, 6))) &&
                           glm::all(glm::lessThan(cell, glm::uvec3(10, 9, 8)));
        cells.push_back(is_in ? 1 : 0);
    }
    Fluid by_cells(test::shared_device(), grid, 0, start);
    by_cells.set_standing(test::shared_device(), cells);
    const auto around = velocity_after(by_cells, style, 2);
    EXPECT_EQ(around, velocity_after(by_shape, style, 2));
    EXPECT_EQ(number_at(around, 0, {8, 5, 7}), 0.0F);
    Fluid free(test::shared_device(), grid, 0, start);
    EXPECT_NE(around, velocity_after(free, style, 2));
    EXPECT_THROW(free.set_standing(test::shared_device(), std::vector<uint8_t>(7)), std::logic_error);
}

TEST(FluidBox, ConfinementFeedsVorticesOfVolumesAcrossTheirAxis)
{
    const Grid grid = room(Edge::periodic);
    // Tests vortices about an axis along x, y and z.
    for (int axis = 0; axis < 3; ++axis) {
        const Flow whirl = [axis](glm::dvec3 place) {
            glm::dvec3 off = place - 0.8;
            off[axis] = 0.0;
            glm::dvec3 along(0.0);
            along[axis] = 1.0;
            return 2.0 * glm::cross(along, off) * std::exp(-glm::dot(off, off) / 0.08);
        };
        FluidStyle style{.step_s = 0.02F, .stepping = Stepping::project};
        const auto start = velocity_of(grid, whirl);
        Fluid calm(test::shared_device(), grid, 0, start);
        const auto without = velocity_after(calm, style, 3);
        style.forces.confinement_per_s = 3.0F;
        Fluid fed(test::shared_device(), grid, 0, start);
        const auto with = velocity_after(fed, style, 3);
        EXPECT_GT(energy(with), 1.02 * energy(without)) << axis;
        const auto of_component = [&](int component) {
            const auto count = static_cast<size_t>(grid.cell_count());
            return energy(std::span(with).subspan(count * static_cast<size_t>(component % 3), count));
        };
        EXPECT_NEAR(of_component(axis + 1) / of_component(axis + 2), 1.0, 1e-3) << "it stays round";
        for (uint32_t i = 0; i < grid.cell_count(); ++i) {
            EXPECT_NEAR(with[static_cast<uint32_t>(axis) * grid.cell_count() + i], 0.0F, 1e-4F) << axis;
        }
    }
    FluidStyle style{.step_s = 0.02F, .stepping = Stepping::project};
    style.forces.confinement_per_s = 3.0F;
    Fluid even(test::shared_device(), grid, 0,
               velocity_of(grid, [](glm::dvec3) { return glm::dvec3(0.5, -0.2, 0.1); }));
    const auto moved = velocity_after(even, style, 2);
    EXPECT_NEAR(number_at(moved, 0, {3, 4, 5}), 0.5F, 1e-4F) << "where nothing turns nothing is fed";
}

} // namespace
} // namespace estampe::fluid
