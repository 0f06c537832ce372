// SPDX-License-Identifier: MIT
// Projections of random and of known fields, by every solver.
#include "techniques/fluid/pressure/projection.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
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

/// What flows out of each cell, in double precision.
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

template <class T>
double norm(const std::vector<T>& numbers)
{
    double sum = 0.0;
    for (const T number : numbers) {
        sum += static_cast<double>(number) * static_cast<double>(number);
    }
    return std::sqrt(sum);
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
         .solids = solids,
         .tables = {add_weights(graph, grid, solids), gpu::import_whole(graph, "angles", angles)},
         .target = graph.image("projected", velocity_desc(grid))},
        false);
    return run_and_read_layers(graph, result.velocity);
}

TEST(FluidProjection, EverySolverTakesDivergenceAway)
{
    for (const Grid& grid : {grid_of(128, 128, wall, wall), grid_of(64, 128, periodic, periodic),
                             grid_of(128, 64, periodic, wall), grid_of(8, 32, wall, periodic),
                             grid_of(100, 75, wall, wall), grid_of(97, 33, wall, periodic)}) {
        const std::vector<float> start = random_velocity(grid);
        const double before = norm(outflow_of(grid, start));
        for (const Solver solver : {Solver::jacobi, Solver::multigrid, Solver::spectral}) {
            if (solver == Solver::spectral && !is_spectral_possible(grid)) {
                continue;
            }
            for (const uint32_t count : {1U, 3U}) {
                const std::vector<float> after =
                    projected(grid, {.solver = solver, .projections = count}, start);
                fmt::print("{}x{} solver {} x{}: {:.2e} energy {:.3f}\n", grid.cells.x, grid.cells.y,
                           (int)solver, count, norm(outflow_of(grid, after)) / before,
                           norm(after) / norm(start));
            }
        }
    }
}

} // namespace
} // namespace estampe::fluid
