// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/projection.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "shaders/fluid_divergence_comp.hpp"
#include "shaders/fluid_gradient_comp.hpp"
#include "shaders/fluid_reflect_comp.hpp"
#include "shaders/fluid_weights_comp.hpp"
#include "techniques/fluid/pressure/levels.hpp"
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
    const uint32_t usual_cycles = grid.is_volume() ? 2 : 3; // a graph has 256 passes
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
    case Solver::automatic:
        break;
    }
    return "automatic";
}

bool is_of_projection(std::string_view pass)
{
    constexpr std::array<std::string_view, 13> names{
        "fluid/divergence", "fluid/gradient",  "fluid/reflect",       "fluid/jacobi",   "fluid/up",
        "fluid/down",       "fluid/small",     "fluid/sweep",         "fluid/restrict", "fluid/coarsest",
        "fluid/divide",     "fluid/transform", "fluid/transform back"};
    return std::ranges::find(names, pass) != names.end();
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

uint32_t passes_of_projection(const Grid& grid, const ProjectionStyle& style, bool has_solids)
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
    return chosen.projections * (of_solve() + 2);
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
        const gpu::BufferId divergence = add_divergence(graph, grid, velocity, input.tables.solids);
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

} // namespace estampe::fluid
