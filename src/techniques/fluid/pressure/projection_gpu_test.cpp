// SPDX-License-Identifier: MIT
// Projects random and known fields with every solver.
#include "techniques/fluid/pressure/projection.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "techniques/fluid/fluid_test_support.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

constexpr Edge periodic = Edge::periodic;
constexpr Edge wall = Edge::no_slip;

Grid grid_of(uint32_t width, uint32_t height, Edge x, Edge y)
{
    return {.cells = {width, height, 1}, .edges = {x, y, wall}};
}

std::vector<float> random_velocity(const Grid& grid)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> speed(-1.0, 1.0);
    return over_nodes(grid, grid.dimensions(), [&](uint32_t component, glm::uvec3 cell) {
        const double chosen = speed(random);
        const bool is_on_wall = !grid.is_periodic(component) && cell[static_cast<int>(component)] == 0;
        return is_on_wall ? 0.0 : chosen;
    });
}

/// Outflow of each cell in double precision.
std::vector<double> outflow_of(const Grid& grid, const std::vector<float>& velocity)
{
    std::vector<double> outflow(grid.cell_count());
    const auto nx = static_cast<size_t>(grid.cells.x);
    const auto ny = static_cast<size_t>(grid.cells.y);
    for (size_t y = 0; y < ny; ++y) {
        for (size_t x = 0; x < nx; ++x) {
            const auto u = [&](size_t i) {
                return i < nx || grid.is_periodic(0) ? static_cast<double>(velocity[y * nx + i % nx]) : 0.0;
            };
            const auto v = [&](size_t j) {
                return j < ny || grid.is_periodic(1)
                           ? static_cast<double>(velocity[nx * ny + j % ny * nx + x])
                           : 0.0;
            };
            outflow[y * nx + x] = u(x + 1) - u(x) + v(y + 1) - v(y);
        }
    }
    return outflow;
}

std::vector<float> projected(const Grid& grid, const ProjectionStyle& style,
                             const std::vector<float>& velocity)
{
    gpu::Device& device = test::shared_device();
    gpu::Image image(device, "velocity", velocity_desc(grid));
    const size_t layer_size = size_t{grid.cells.x} * grid.cells.y;
    gpu::upload_layers(device, image, [&](uint32_t layer) {
        const auto bytes = std::as_bytes(std::span(velocity).subspan(layer * layer_size, layer_size));
        return gpu::LayerPixels{.levels = {{bytes.begin(), bytes.end()}}};
    });
    gpu::Buffer cells = gpu::upload_buffer(device, "solids", std::vector<uint32_t>(grid.cell_count()));
    gpu::Buffer angles = upload_angles(device, grid);
    gpu::Graph graph;
    const Solids solids{gpu::import_whole(graph, "solids", cells)};
    const Projected result = add_projection(
        graph, grid, style,
        {.velocity = gpu::import_uploaded(graph, "velocity", image),
         .tables = {solids, add_weights(graph, grid, solids), gpu::import_whole(graph, "angles", angles)},
         .target = graph.image("projected", velocity_desc(grid))},
        false);
    return run_and_read_layers(graph, result.velocity);
}

double difference(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
    }
    return std::sqrt(sum);
}

std::vector<Solver> exact_solvers(const Grid& grid)
{
    return is_spectral_possible(grid) ? std::vector{Solver::multigrid, Solver::spectral}
                                      : std::vector{Solver::multigrid};
}

const std::vector<Grid>& grids()
{
    static const std::vector<Grid> all{grid_of(128, 128, wall, wall), grid_of(64, 128, periodic, periodic),
                                       grid_of(128, 64, periodic, wall), grid_of(8, 32, wall, periodic),
                                       grid_of(100, 75, wall, wall)};
    return all;
}

TEST(FluidProjection, ThreeInARowLeaveNoDivergence)
{
    for (const Grid& grid : grids()) {
        const std::vector<float> start = random_velocity(grid);
        for (const Solver solver : exact_solvers(grid)) {
            const std::vector<float> once = projected(grid, {.solver = solver, .projections = 3}, start);
            const double left = norm(outflow_of(grid, once)) / norm(outflow_of(grid, start));
            EXPECT_LE(left, 1e-5) << grid.cells.x << " x " << grid.cells.y << ", "
                                  << static_cast<int>(solver);
            EXPECT_LE(norm(once), norm(start));
            const std::vector<float> twice = projected(grid, {.solver = solver, .projections = 3}, once);
            EXPECT_LE(difference(once, twice), 2e-5 * norm(start));
        }
    }
}

TEST(FluidProjection, SolversThatShareNothingAgree)
{
    for (const Grid& grid : grids()) {
        if (is_spectral_possible(grid)) {
            const std::vector<float> start = random_velocity(grid);
            const std::vector<float> direct = projected(grid, {.solver = Solver::spectral}, start);
            const std::vector<float> cycled =
                projected(grid, {.solver = Solver::multigrid, .projections = 4}, start);
            EXPECT_LE(difference(direct, cycled), 1e-5 * norm(start))
                << grid.cells.x << " x " << grid.cells.y;
        }
    }
}

TEST(FluidProjection, EdgesThatMeetAfterAnOddNumberOfCellsTakeMoreCycles)
{
    for (const Grid& grid : {grid_of(97, 33, wall, periodic), grid_of(130, 12, periodic, wall)}) {
        const std::vector<float> start = random_velocity(grid);
        const std::vector<float> after = projected(grid, {.projections = 6}, start);
        EXPECT_LE(norm(outflow_of(grid, after)) / norm(outflow_of(grid, start)), 1e-5);
    }
}

TEST(FluidProjection, GradientsVanish)
{
    for (const Grid& grid : grids()) {
        const auto potential = [&](glm::uvec3 cell, glm::ivec2 before) {
            const glm::dvec2 turns = 2.0 * std::numbers::pi *
                                     (glm::dvec2(glm::uvec2(cell)) - glm::dvec2(before)) /
                                     glm::dvec2(glm::uvec2(grid.cells));
            return 3.0 * std::sin(turns.x + 0.3) * std::cos(2.0 * turns.y) + std::cos(3.0 * turns.y);
        };
        const std::vector<float> start = over_nodes(grid, 2, [&](uint32_t component, glm::uvec3 cell) {
            const bool is_on_wall = !grid.is_periodic(component) && cell[static_cast<int>(component)] == 0;
            return is_on_wall ? 0.0
                              : potential(cell, {0, 0}) -
                                    potential(cell, component == 0 ? glm::ivec2(1, 0) : glm::ivec2(0, 1));
        });
        for (const Solver solver : exact_solvers(grid)) {
            EXPECT_LE(norm(projected(grid, {.solver = solver, .projections = 3}, start)), 1e-4 * norm(start))
                << grid.cells.x << " x " << grid.cells.y << ", " << static_cast<int>(solver);
        }
    }
}

/// A gust an eighth of the grid wide, because solvers differ in large-scale flow.
std::vector<float> gust(const Grid& grid)
{
    return velocity_of(grid, [&](glm::dvec3 p) {
        const glm::dvec2 off = (glm::dvec2(p) / static_cast<double>(grid.cells.x) - 0.5) / 0.08;
        return glm::dvec3(std::exp(-glm::dot(off, off)), 0.0, 0.0);
    });
}

TEST(FluidProjection, WhatIsLargeTakesMoreThanJacobi)
{
    const Grid grid = grid_of(256, 256, wall, wall);
    const std::vector<float> start = gust(grid);
    const auto left = [&](const ProjectionStyle& style) {
        return norm(outflow_of(grid, projected(grid, style, start))) / norm(outflow_of(grid, start));
    };
    const double jacobi = left({.solver = Solver::jacobi, .jacobi_rounds = 80});
    EXPECT_GT(jacobi, 0.8);
    EXPECT_LT(jacobi, 1.0);
    EXPECT_LT(left({.solver = Solver::jacobi, .jacobi_rounds = 321}), 0.9 * jacobi);
    EXPECT_LT(left({.solver = Solver::multigrid, .projections = 1}), 0.2);
    EXPECT_LT(left({}), 1e-3) << "automatic";
    EXPECT_LT(left({.solver = Solver::multigrid}), 5e-3) << "as often as multigrid does by default";
}

TEST(FluidProjection, SpectralSaysWhereItCannot)
{
    EXPECT_EQ(solver_for(grid_of(64, 64, wall, wall), Solver::automatic, false), Solver::spectral);
    EXPECT_EQ(solver_for(grid_of(64, 64, wall, wall), Solver::automatic, true), Solver::multigrid);
    EXPECT_EQ(solver_for(grid_of(60, 64, wall, wall), Solver::automatic, false), Solver::multigrid);
    EXPECT_THROW(static_cast<void>(solver_for(grid_of(60, 64, wall, wall), Solver::spectral, false)),
                 std::logic_error);
    EXPECT_THROW(static_cast<void>(solver_for(grid_of(64, 64, wall, wall), Solver::spectral, true)),
                 std::logic_error);
}

TEST(FluidProjection, ItsPassesAreKnownByTheirNames)
{
    gpu::Executor executor(test::shared_device());
    const auto timed = [&](const Grid& grid, const ProjectionStyle& style) {
        static_cast<void>(measured_residual(test::shared_device(), executor, grid, style));
        size_t known = 0;
        for (const PassTiming& pass : executor.timings_of_run()) {
            const bool is_beside = pass.name == "fluid/weights" || pass.name == "fluid/zeros" ||
                                   pass.name.starts_with("fluid/pressure");
            EXPECT_NE(is_of_projection(pass.name), is_beside) << pass.name;
            known += is_beside ? 0 : 1;
        }
        return known;
    };
    for (const Solver solver : {Solver::jacobi, Solver::multigrid, Solver::spectral}) {
        EXPECT_GT(timed(grid_of(128, 128, wall, wall), {.solver = solver}), 0U) << name_of(solver);
        EXPECT_GT(timed({.cells = {16, 16, 16}, .edges = {wall, wall, wall}}, {.solver = solver}), 0U)
            << name_of(solver);
    }
    EXPECT_FALSE(is_of_projection("fluid/advect"));
}

TEST(FluidProjection, VolumesAreSolvedDirectly)
{
    gpu::Executor executor(test::shared_device());
    for (const auto& [x, y, z] : {std::tuple(wall, wall, wall),
                                  {periodic, wall, periodic},
                                  {wall, periodic, wall},
                                  {periodic, periodic, periodic}}) {
        const Grid grid{.cells = {16, 8, 32}, .edges = {x, y, z}};
        EXPECT_EQ(solver_for(grid, Solver::automatic, false), Solver::spectral);
        EXPECT_LE(measured_residual(test::shared_device(), executor, grid, {}), 2e-6);
    }
    // Seven cells in the periodic direction: with an even number Jacobi's iteration does not converge on a
    // chess-board pattern.
    const Grid odd{.cells = {10, 7, 5}, .edges = {wall, periodic, wall}};
    const auto left = [&](uint32_t rounds) {
        return measured_residual(test::shared_device(), executor, odd,
                                 {.solver = Solver::jacobi, .jacobi_rounds = rounds});
    };
    EXPECT_LE(left(200), 1e-2);
    EXPECT_LE(left(200), 0.5 * left(60));
}

TEST(FluidProjection, LongRowsAreTransformedToo)
{
    gpu::Executor executor(test::shared_device());
    for (const auto& [cells, x, y] :
         {std::tuple(glm::uvec3(4096, 4, 1), wall, wall), {glm::uvec3(4, 4096, 1), wall, periodic}}) {
        const Grid grid{.cells = cells, .edges = {x, y, wall}};
        EXPECT_LE(measured_residual(test::shared_device(), executor, grid, {.solver = Solver::spectral}),
                  2e-4)
            << cells.x;
    }
}

TEST(FluidProjection, VolumesConvergeByCycles)
{
    gpu::Executor executor(test::shared_device());
    for (const auto& [cells, x, y, z] : {std::tuple(glm::uvec3(32, 32, 32), wall, wall, wall),
                                         {glm::uvec3(24, 16, 40), periodic, wall, periodic},
                                         {glm::uvec3(17, 30, 9), wall, wall, wall}}) {
        const Grid grid{.cells = cells, .edges = {x, y, z}};
        EXPECT_LE(measured_residual(test::shared_device(), executor, grid, {.solver = Solver::multigrid}),
                  0.03)
            << cells.x;
    }
}

} // namespace
} // namespace estampe::fluid
