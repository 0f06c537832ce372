// SPDX-License-Identifier: MIT
// Fluid features that smoke in a box needs: open ends, permanently solid cells, vorticity confinement in
// volumes, expansion of hot air.
#include <array>
#include <numeric>
#include <span>

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

constexpr uint32_t air_side = 32;
constexpr double hottest = 4.0;
constexpr std::array all_solvers{Solver::spectral, Solver::multigrid, Solver::jacobi, Solver::mass};

Grid air(Edge edge = Edge::periodic)
{
    return {.cells = glm::uvec3(air_side), .cell_m = 0.05F, .edges = {edge, edge, edge}};
}

/// No force acts, and nothing cools but by expansion, from a temperature of 4 to 1.
FluidStyle exploding(Solver solver, float per_s = 6.0F)
{
    FluidStyle style{.step_s = 1.0F / 48.0F, .stepping = Stepping::project, .projection = {.solver = solver}};
    style.forces.rim = {.breadth_m = 0.25F, .share_per_s = 4.0F};
    style.matter.expands_above = 1.0F;
    style.matter.expansion_per_s = per_s;
    style.matter.rim = {.breadth_m = 0.25F, .share_per_s = 4.0F};
    return style;
}

/// Density, and a temperature, in a ball of `radius_cells` in the middle, with an edge of three cells.
std::vector<float> ball(const Grid& grid, double radius_cells, double temperature = hottest)
{
    return over_nodes(grid, 2, [&](uint32_t channel, glm::uvec3 cell) {
        const double away = glm::distance(glm::dvec3(cell) + 0.5, glm::dvec3(0.5 * air_side));
        return std::clamp((radius_cells + 1.5 - away) / 3.0, 0.0, 1.0) * (channel == 0 ? 1.0 : temperature);
    });
}

struct Air {
    std::vector<float> velocity;
    std::vector<float> quantities;
};

Air air_after(Fluid& fluid, const FluidStyle& style, uint32_t count)
{
    fluid.ensure_mass(test::shared_device(), style);
    for (uint32_t left = count;;) {
        const uint32_t now = std::min(left, fluid.most_steps(style));
        gpu::Graph graph;
        const FluidFields fields = fluid.add_steps(graph, style, now);
        left -= now;
        if (left == 0) {
            const auto velocity = run_and_read_layers(graph, fields.velocity);
            gpu::Graph more;
            return {velocity, run_and_read_layers(more, *fluid.add_steps(more, style, 0).quantities)};
        }
        static_cast<void>(run_and_read_layers(graph, fields.velocity));
    }
}

size_t index_of(glm::ivec3 cell)
{
    return static_cast<size_t>((cell.z * static_cast<int>(air_side) + cell.y) * static_cast<int>(air_side) +
                               cell.x);
}

double speed_at(const Air& air, int axis, glm::ivec3 cell)
{
    const size_t count = size_t{air_side} * air_side * air_side;
    return static_cast<double>(air.velocity[static_cast<size_t>(axis) * count + index_of(cell)]);
}

double temperature_at(const Air& air, glm::ivec3 cell)
{
    return static_cast<double>(air.quantities[size_t{air_side} * air_side * air_side + index_of(cell)]);
}

void for_cells(int from, int to, const auto& visit)
{
    for (int z = from; z < to; ++z) {
        for (int y = from; y < to; ++y) {
            for (int x = from; x < to; ++x) {
                visit(glm::ivec3(x, y, z));
            }
        }
    }
}

/// Flow out of the cube of cells from `from` to `to` along each axis, through its six sides, in cell faces
/// times metres per second.
double flux_out(const Air& air, int from, int to)
{
    double flux = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int a = from; a < to; ++a) {
            for (int b = from; b < to; ++b) {
                glm::ivec3 cell(a, a, a);
                cell[(axis + 1) % 3] = b;
                cell[axis] = to;
                flux += speed_at(air, axis, cell);
                cell[axis] = from;
                flux -= speed_at(air, axis, cell);
            }
        }
    }
    return flux;
}

/// Outflow that the law of expansion gives a cell in a step, in metres per second.
double wanted_at(const Air& air, const FluidStyle& style, glm::ivec3 cell)
{
    const double hot = temperature_at(air, cell);
    const auto limit = static_cast<double>(style.matter.expands_above);
    const auto step_s = static_cast<double>(style.step_s);
    const double kept = std::exp(-static_cast<double>(style.matter.expansion_per_s) * step_s);
    return hot > limit ? std::log(hot / (limit + (hot - limit) * kept)) * 0.05 / step_s : 0.0;
}

double wanted_within(const Air& air, const FluidStyle& style, int from, int to)
{
    double sum = 0.0;
    for_cells(from, to, [&](glm::ivec3 cell) { sum += wanted_at(air, style, cell); });
    return sum;
}

TEST(FluidExpansion, AsMuchFlowsOutOfASurfaceAsExpandsWithin)
{
    for (const Stepping stepping : {Stepping::project, Stepping::reflect}) {
        for (const Solver solver : {Solver::spectral, Solver::multigrid, Solver::jacobi}) {
            FluidStyle style = exploding(solver, 0.4F); // slow, because Jacobi's iteration takes some steps
            style.stepping = stepping;
            const Grid grid = air();
            Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
            const Air before = air_after(fluid, style, solver == Solver::jacobi ? 16 : 2);
            const Air now = air_after(fluid, style, 1);
            for (const int reach : {6, 8, 10}) {
                const int from = static_cast<int>(air_side) / 2 - reach;
                const int to = static_cast<int>(air_side) / 2 + reach;
                // Reflection projects with the temperature that the step before left.
                const double wanted =
                    wanted_within(stepping == Stepping::reflect ? before : now, style, from, to);
                ASSERT_GT(wanted, 0.1);
                EXPECT_NEAR(flux_out(now, from, to) / wanted, 1.0, solver == Solver::jacobi ? 0.03 : 1e-4)
                    << name_of(solver) << ", " << reach;
            }
        }
    }
}

TEST(FluidExpansion, WithAMassAsMuchFlowsOutOnAverage)
{
    const Grid grid = air();
    const FluidStyle style = exploding(Solver::mass, 0.4F);
    Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
    static_cast<void>(air_after(fluid, style, 16));
    for (const int reach : {6, 8, 10}) {
        const int from = static_cast<int>(air_side) / 2 - reach;
        const int to = static_cast<int>(air_side) / 2 + reach;
        double flux = 0.0;
        double wanted = 0.0;
        for (int i = 0; i < 24; ++i) { // sound runs to and fro
            const Air now = air_after(fluid, style, 1);
            flux += flux_out(now, from, to);
            wanted += wanted_within(now, style, from, to);
        }
        EXPECT_NEAR(flux / wanted, 1.0, 0.1) << reach;
    }
}

TEST(FluidExpansion, InAClosedRoomTheRestIsCompressed)
{
    const Grid grid = air(Edge::free_slip);
    FluidStyle style = exploding(Solver::multigrid, 0.4F);
    style.forces.rim = {};
    style.matter.rim = {};
    style.projection.projections = 4;
    Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
    const Air now = air_after(fluid, style, 2);
    const double whole = wanted_within(now, style, 0, air_side);
    const double within = wanted_within(now, style, 8, 24);
    EXPECT_NEAR(flux_out(now, 8, 24) / (within - whole / 8.0), 1.0, 2e-3);
}

TEST(FluidExpansion, AirAroundMovesAwayByTheSquareOfTheDistance)
{
    for (const Solver solver : {Solver::spectral, Solver::multigrid}) {
        const FluidStyle style = exploding(solver, 0.4F);
        const Grid grid = air();
        Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 2.5));
        const Air now = air_after(fluid, style, 2);
        const double strength =
            wanted_within(now, style, 8, 24) / (4.0 * std::numbers::pi); // of a point, in cells
        const int middle = air_side / 2;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int away : {4, 5, 6, 7, 8}) {
                double speed = 0.0;
                for (int side = -1; side <= 1; side += 2) {
                    for (int beside = 0; beside < 4; ++beside) { // the four faces around the axis
                        glm::ivec3 cell(middle);
                        cell[(axis + 1) % 3] -= beside % 2;
                        cell[(axis + 2) % 3] -= beside / 2;
                        cell[axis] += side * away;
                        speed += side * speed_at(now, axis, cell) / 8.0;
                    }
                }
                // The faces lie half a cell beside the axis along both other axes.
                const double square = away * away + 0.5;
                const double wanted = strength * away / std::pow(square, 1.5);
                EXPECT_NEAR(speed / wanted, 1.0, 0.1) << name_of(solver) << ' ' << axis << ' ' << away;
            }
        }
    }
}

/// Sum of a quantity over all cells.
double sum_of(const Air& air, size_t channel)
{
    const size_t count = size_t{air_side} * air_side * air_side;
    const auto of_channel = std::span(air.quantities).subspan(channel * count, count);
    return std::accumulate(of_channel.begin(), of_channel.end(), 0.0);
}

double energy_of(const Air& air)
{
    return std::pow(norm(air.velocity), 2.0);
}

/// Air in which a source has heated a ball of `radius_cells` to the hottest temperature, within the first
/// step.
Air heated(Fluid& fluid, const FluidStyle& style, float radius_cells)
{
    Source source{.shape = disc(glm::vec3(0.8F), 0.05F * radius_cells)};
    source.gain_per_s[shared::fluid_density] = 1.0F / style.step_s;
    source.gain_per_s[shared::fluid_temperature] = static_cast<float>(hottest) / style.step_s;
    fluid.set_shapes({}, {&source, 1});
    Air air = air_after(fluid, style, 1);
    fluid.set_shapes({}, {});
    return air;
}

TEST(FluidExpansion, ABallGrowsByItsHeatAndKeepsIt)
{
    const Grid grid = air();
    for (const Solver solver : {Solver::spectral, Solver::multigrid, Solver::jacobi}) {
        const FluidStyle style = exploding(solver, 12.0F);
        Fluid fluid(test::shared_device(), grid, 2);
        const Air start = heated(fluid, style, 6.0F);
        // Each cell should gain its own volume times the excess of its temperature over 1.
        double wanted_cells = 0.0;
        for_cells(0, air_side,
                  [&](glm::ivec3 cell) { wanted_cells += std::max(temperature_at(start, cell) - 1.0, 0.0); });
        const auto gain_in_a_step = [&](const Air& now) {
            return flux_out(now, 5, 27) * static_cast<double>(style.step_s) /
                   static_cast<double>(grid.cell_m);
        };
        double gained_cells = gain_in_a_step(start);
        Air end;
        for (int i = 0; i < 36; ++i) {
            end = air_after(fluid, style, 1);
            gained_cells += gain_in_a_step(end);
        }
        const double heat = sum_of(end, 1) / sum_of(start, 1);
        // The advection loses heat at the ball's edge, which is a cell wide, but never gains any.
        EXPECT_GT(gained_cells / wanted_cells, 0.7) << name_of(solver);
        EXPECT_LT(gained_cells / wanted_cells, 1.02) << name_of(solver);
        EXPECT_GT(heat, 0.8) << name_of(solver);
        EXPECT_LT(heat, 1.002) << name_of(solver);
    }
}

TEST(FluidExpansion, WithAMassABallGrowsByItsHeat)
{
    const Grid grid = air();
    const FluidStyle style = exploding(Solver::mass, 12.0F);
    Fluid fluid(test::shared_device(), grid, 2);
    const Air start = heated(fluid, style, 5.0F);
    // Number of cells over which the density is spread: of a ball of one density, its volume.
    const auto spread_of = [](const Air& now) {
        const double root = norm(std::vector<float>(now.quantities.begin(),
                                                    now.quantities.begin() + air_side * air_side * air_side));
        return std::pow(sum_of(now, 0) / root, 2.0);
    };
    const Air end = air_after(fluid, style, 36);
    EXPECT_NEAR(spread_of(end) / spread_of(start), hottest, 0.2 * hottest);
    EXPECT_NEAR(sum_of(end, 1) / sum_of(start, 1), 1.0, 0.01);
}

TEST(FluidExpansion, APuffEnds)
{
    for (const Solver solver : all_solvers) {
        for (const float per_s : {6.0F, 24.0F}) {
            const FluidStyle style = exploding(solver, per_s);
            const Grid grid = air();
            Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
            double most = 0.0;
            double last = 0.0;
            const double heat = sum_of({{}, ball(grid, 4.0)}, 1);
            for (int i = 0; i < 24; ++i) {
                const Air now = air_after(fluid, style, 4);
                last = energy_of(now);
                most = std::max(most, last);
                EXPECT_LT(sum_of(now, 1), 1.002 * heat) << name_of(solver) << ' ' << i;
            }
            EXPECT_LT(last, (solver == Solver::mass ? 0.05 : 0.001) * most) << name_of(solver);
        }
    }
}

TEST(FluidExpansion, CoolAirIsAsWithoutItToTheBit)
{
    for (const Stepping stepping : {Stepping::project, Stepping::reflect}) {
        for (const Solver solver : all_solvers) {
            const Grid grid = air();
            FluidStyle style = exploding(solver);
            style.stepping = stepping;
            style.forces.lift_m_s2 = 1.0F;
            const auto risen = [&](float expands_above) {
                style.matter.expands_above = expands_above;
                Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
                return air_after(fluid, style, 3);
            };
            const Air without = risen(0.0F);
            const Air cool = risen(5.0F);
            EXPECT_EQ(cool.velocity, without.velocity) << name_of(solver);
            EXPECT_EQ(cool.quantities, without.quantities) << name_of(solver);
            EXPECT_NE(risen(2.0F).velocity, without.velocity) << name_of(solver);
        }
    }
}

TEST(FluidExpansion, StandingCellsNeitherExpandNorLetAnythingOut)
{
    const Grid grid = air();
    const FluidStyle style = exploding(Solver::multigrid, 0.4F);
    Fluid fluid(test::shared_device(), grid, 2, {}, ball(grid, 4.0));
    std::vector<uint8_t> floor(grid.cell_count());
    for_cells(0, air_side, [&](glm::ivec3 cell) { floor[index_of(cell)] = cell.y < 14 ? 1 : 0; });
    fluid.set_standing(test::shared_device(), floor);
    const Air now = air_after(fluid, style, 3);
    for_cells(1, air_side - 1, [&](glm::ivec3 cell) {
        if (cell.y < 14) {
            ASSERT_EQ(speed_at(now, 1, cell), 0.0);
        }
    });
    double wanted = 0.0;
    for_cells(6, 26, [&](glm::ivec3 cell) { wanted += cell.y < 14 ? 0.0 : wanted_at(now, style, cell); });
    EXPECT_NEAR(flux_out(now, 6, 26) / wanted, 1.0, 0.02);
}

} // namespace
} // namespace estampe::fluid
