// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/hash.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/fluid_divergence_comp.hpp"
#include "shaders/fluid_gradient_comp.hpp"
#include "shaders/fluid_reflect_comp.hpp"
#include "shaders/fluid_weights_comp.hpp"
#include "techniques/fluid/alternatives/jacobi.hpp"
#include "techniques/fluid/pressure/expansion.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

uint32_t bits_of(const Grid& grid, const Solids& solids)
{
    return grid_bits(grid) | (solids.are_any ? shared::fluid_bit_solids : 0U);
}

gpu::ImageId add_gradient(gpu::Graph& graph, const Grid& grid, const Solids& solids, gpu::ImageId velocity,
                          gpu::BufferId pressure, gpu::ImageId target)
{
    auto pass = graph.compute("fluid/gradient", shaders::fluid_gradient_comp);
    pass.sample(velocity).sample(pressure, gpu::Format::r32f).sample(solids.cells, gpu::Format::r32ui);
    const gpu::ImageId out = pass.write(target);
    pass.push(grid_constants(grid)).variant(bits_of(grid, solids));
    dispatch_over_cells(pass, grid);
    return out;
}

Projected add_reflection(gpu::Graph& graph, const Grid& grid, const ProjectionInput& input,
                         gpu::ImageId velocity, gpu::BufferId pressure)
{
    auto pass = graph.compute("fluid/reflect", shaders::fluid_reflect_comp);
    pass.sample(velocity)
        .sample(pressure, gpu::Format::r32f)
        .sample(input.tables.solids.cells, gpu::Format::r32ui)
        .sample(input.velocity);
    const gpu::ImageId out = pass.write(input.target);
    const gpu::ImageId reflected = pass.write(graph.image("fluid/reflected", velocity_desc(grid)));
    pass.push(grid_constants(grid)).variant(bits_of(grid, input.tables.solids));
    dispatch_over_cells(pass, grid);
    return {out, reflected};
}

ProjectionStyle chosen_style(const Grid& grid, const ProjectionStyle& style, bool has_solids)
{
    // A 3D cycle has more passes, and a graph has at most 256 passes.
    const uint32_t usual_cycles = grid.is_volume() ? 2 : 3;
    ProjectionStyle chosen = style;
    chosen.solver = solver_for(grid, style.solver, has_solids);
    if (style.projections == 0) {
        chosen.projections = chosen.solver == Solver::multigrid ? usual_cycles : 1;
    }
    return chosen;
}

} // namespace

const char* name_of(Solver solver)
{
    switch (solver) {
    case Solver::jacobi:
        return "jacobi";
    case Solver::multigrid:
        return "multigrid";
    case Solver::spectral:
        return "spectral";
    case Solver::mass:
        return "mass";
    case Solver::automatic:
        break;
    }
    return "automatic";
}

bool is_of_projection(std::string_view pass)
{
    constexpr std::array<std::string_view, 16> names{
        "fluid/divergence", "fluid/gradient",  "fluid/reflect",        "fluid/jacobi",   "fluid/up",
        "fluid/down",       "fluid/small",     "fluid/sweep",          "fluid/restrict", "fluid/coarsest",
        "fluid/divide",     "fluid/transform", "fluid/transform back", "fluid/expand",   "fluid/vent",
        "fluid/swell"};
    return std::ranges::find(names, pass) != names.end() || pass.starts_with("fluid/medium");
}

Solver solver_for(const Grid& grid, Solver solver, bool has_solids)
{
    const bool is_possible = is_spectral_possible(grid) && !has_solids;
    if (solver == Solver::spectral && !is_possible) {
        throw std::logic_error("the spectral solver wants sizes that are powers of two, and no obstacles");
    }
    return solver != Solver::automatic ? solver : is_possible ? Solver::spectral : Solver::multigrid;
}

gpu::BufferId add_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids)
{
    if (grid.is_volume()) {
        return add_volume_weights(graph, grid, solids);
    }
    const std::vector<shared::FluidLevel> levels = levels_of(grid);
    const uint32_t count = levels.back().first + cell_count(levels.back());
    auto pass = graph.compute("fluid/weights", shaders::fluid_weights_comp);
    pass.sample(solids.cells, gpu::Format::r32ui);
    const gpu::BufferId weights =
        pass.write(graph.buffer("fluid/weights", {.size_bytes = sizeof(uint32_t) * uint64_t{count}}));
    pass
        .push(WithGrid<shared::FluidWeights>{
            grid_constants(grid), {.level_count = static_cast<uint32_t>(levels.size()), .cell_count = count}})
        .variant(bits_of(grid, solids))
        .dispatch_items(count);
    return weights;
}

gpu::BufferId add_divergence(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity, const Solids& solids,
                             const char* name)
{
    auto pass = graph.compute(name, shaders::fluid_divergence_comp);
    pass.sample(velocity).sample(solids.cells, gpu::Format::r32ui);
    const gpu::BufferId divergence =
        pass.write(graph.buffer("fluid/divergence", {.size_bytes = sizeof(float) * grid.cell_count()}));
    pass.push(grid_constants(grid)).variant(bits_of(grid, solids));
    dispatch_over_cells(pass, grid);
    return divergence;
}

uint32_t passes_of_projection(const Grid& grid, const ProjectionStyle& style, bool has_solids, bool expands)
{
    const ProjectionStyle chosen = chosen_style(grid, style, has_solids);
    const auto of_solve = [&] {
        switch (chosen.solver) {
        case Solver::spectral:
            return 2 * grid.dimensions() - 1;
        case Solver::jacobi:
            return passes_of_jacobi(grid, style.jacobi_rounds);
        default:
            break;
        }
        return grid.is_volume() ? passes_of_volume_cycle(grid)
                                : 2 * static_cast<uint32_t>(levels_of(grid).size()) - 1;
    };
    return chosen.projections * (of_solve() + 2 + (expands ? 1 : 0));
}

gpu::BufferId add_pressure(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                           gpu::BufferId divergence, const SolverTables& tables)
{
    const Equation equation{divergence, tables.solids, tables.weights};
    switch (style.solver) {
    case Solver::jacobi:
        return add_jacobi(graph, grid, equation, style.jacobi_rounds);
    case Solver::spectral:
        return add_spectral(graph, grid, equation, tables.angles);
    case Solver::mass:
        throw std::logic_error("the solver by mass solves for no pressure");
    default:
        return grid.is_volume() ? add_volume_cycle(graph, grid, equation)
                                : add_v_cycle(graph, grid, equation);
    }
}

Projected add_projection(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                         const ProjectionInput& input, bool reflects)
{
    const ProjectionStyle chosen = chosen_style(grid, style, input.tables.solids.are_any);
    gpu::ImageId velocity = input.velocity;
    for (uint32_t i = 0;; ++i) {
        gpu::BufferId divergence = add_divergence(graph, grid, velocity, input.tables.solids);
        if (input.swelling) {
            divergence = add_swelling_to_outflow(graph, grid, *input.swelling, divergence);
        }
        const gpu::BufferId pressure = add_pressure(graph, grid, chosen, divergence, input.tables);
        if (i + 1 < chosen.projections) {
            velocity = add_gradient(graph, grid, input.tables.solids, velocity, pressure,
                                    graph.image("fluid/projected", velocity_desc(grid)));
        } else if (reflects) {
            return add_reflection(graph, grid, input, velocity, pressure);
        } else {
            velocity = add_gradient(graph, grid, input.tables.solids, velocity, pressure, input.target);
            return {velocity, velocity};
        }
    }
}

namespace {

/// Random numbers from -1 to 1 with the sum zero, up to rounding.
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

/// Left side of the pressure equation: the sum over a cell's neighbours of the neighbour's pressure minus the
/// cell's pressure.
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
