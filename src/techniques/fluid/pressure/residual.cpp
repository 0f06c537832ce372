// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/residual.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hash.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "gpu/upload.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

/// Numbers of -1 to 1 whose sum is zero, to rounding.
std::vector<float> random_divergence(uint64_t count)
{
    std::vector<float> numbers;
    for (uint64_t i = 0; i < count; ++i) {
        Hash hash;
        hash.add(i / 2);
        const double random = static_cast<double>(hash.value() >> 32U) / 2147483648.0 - 1.0;
        numbers.push_back(static_cast<float>(i % 2 == 0 ? random : -random));
    }
    if (count % 2 == 1) {
        numbers.back() = 0.0F;
    }
    return numbers;
}

/// Sum over the neighbours of a cell of their pressure less its own.
double differences(const Grid& grid, std::span<const float> pressure, glm::ivec3 cell)
{
    const glm::ivec3 size(grid.cells);
    const auto at = [&](glm::ivec3 place) {
        return static_cast<double>(
            pressure[static_cast<size_t>((place.z * size.y + place.y) * size.x + place.x)]);
    };
    double sum = 0.0;
    for (int axis = 0; axis < static_cast<int>(grid.dimensions()); ++axis) {
        for (const int step : {-1, 1}) {
            glm::ivec3 place = cell;
            place[axis] += step;
            const bool is_outside = place[axis] < 0 || place[axis] >= size[axis];
            if (is_outside && !grid.is_periodic(static_cast<uint32_t>(axis))) {
                continue;
            }
            place[axis] = (place[axis] + size[axis]) % size[axis];
            sum += at(place) - at(cell);
        }
    }
    return sum;
}

} // namespace

double measured_residual(gpu::Device& device, gpu::Executor& executor, const Grid& grid,
                         const ProjectionStyle& style)
{
    const std::vector<float> divergence = random_divergence(grid.cell_count());
    gpu::Buffer start = gpu::upload_buffer(device, "fluid divergence", divergence);
    gpu::Buffer cells = gpu::upload_buffer(device, "fluid solids", std::vector<uint32_t>(grid.cell_count()));
    gpu::Buffer angles = upload_angles(device, grid);
    gpu::Buffer host(device, "fluid pressure", start.size_bytes(), gpu::MemoryUse::readback);
    gpu::Graph graph;
    const Solids solids{.cells = gpu::import_whole(graph, "fluid/solids", cells)};
    const SolverTables tables{.solids = solids,
                              .weights = add_weights(graph, grid, solids),
                              .angles = gpu::import_whole(graph, "fluid/angles", angles)};
    ProjectionStyle chosen = style;
    chosen.solver = solver_for(grid, style.solver, false);
    const gpu::BufferId pressure =
        add_pressure(graph, grid, chosen, gpu::import_whole(graph, "fluid/divergence", start), tables);
    gpu::add_read_back(graph, "fluid/pressure", pressure, host);
    executor.run(graph);
    const auto solved = gpu::items_of<float>(host);
    double left = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < divergence.size(); ++i) {
        const auto n = static_cast<uint32_t>(i);
        const glm::ivec3 cell(n % grid.cells.x, n / grid.cells.x % grid.cells.y,
                              n / (grid.cells.x * grid.cells.y));
        const auto wanted = static_cast<double>(divergence[i]);
        left += std::pow(differences(grid, solved, cell) - wanted, 2.0);
        all += wanted * wanted;
    }
    return std::sqrt(left / all);
}

} // namespace estampe::fluid
