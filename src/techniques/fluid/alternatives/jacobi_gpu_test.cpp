// SPDX-License-Identifier: MIT
// Compares Jacobi's iteration on the device with plain loops on the CPU.
#include "techniques/fluid/alternatives/jacobi.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::fluid {
namespace {

/// Runs rounds from zero, with walls along y and periodic along x.
std::vector<double> plain_jacobi(const Grid& grid, const std::vector<float>& divergence, uint32_t rounds)
{
    const auto nx = static_cast<int>(grid.cells.x);
    const auto ny = static_cast<int>(grid.cells.y);
    std::vector<double> pressure(divergence.size());
    for (uint32_t round = 0; round < rounds; ++round) {
        const std::vector<double> last = pressure;
        for (int i = 0; i < nx * ny; ++i) {
            const int x = i % nx;
            const int y = i / nx;
            double sum = last[static_cast<size_t>(y * nx + (x + 1) % nx)] +
                         last[static_cast<size_t>(y * nx + (x + nx - 1) % nx)];
            double faces = 2.0;
            for (const int next : {y - 1, y + 1}) {
                if (next >= 0 && next < ny) {
                    sum += last[static_cast<size_t>(next * nx + x)];
                    faces += 1.0;
                }
            }
            const auto n = static_cast<size_t>(i);
            pressure[n] = (sum - static_cast<double>(divergence[n])) / faces;
        }
    }
    return pressure;
}

TEST(FluidJacobi, IsThatOfPlainLoops)
{
    const Grid grid{.cells = {70, 37, 1}, .edges = {Edge::periodic, Edge::no_slip, Edge::no_slip}};
    std::vector<float> divergence(grid.cell_count());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> outflow(-2.0F, 2.0F);
    std::ranges::generate(divergence, [&] { return outflow(random); });
    gpu::Device& device = test::shared_device();
    gpu::Buffer cells = gpu::upload_buffer(device, "solids", std::vector<uint32_t>(grid.cell_count()));
    gpu::Buffer start = gpu::upload_buffer(device, "divergence", divergence);
    for (const uint32_t rounds : {1U, 4U, 7U, 30U}) {
        gpu::Graph graph;
        const Solids solids{gpu::import_whole(graph, "solids", cells)};
        const gpu::BufferId pressure = add_jacobi(
            graph, grid,
            {gpu::import_whole(graph, "divergence", start), solids, add_weights(graph, grid, solids)},
            rounds);
        const auto solved = test::run_and_read_as<float>(graph, pressure);
        const std::vector<double> plain = plain_jacobi(grid, divergence, rounds);
        for (size_t i = 0; i < plain.size(); ++i) {
            ASSERT_NEAR(static_cast<double>(solved[i]), plain[i], 1e-5) << rounds << " rounds, cell " << i;
        }
    }
}

} // namespace
} // namespace estampe::fluid
