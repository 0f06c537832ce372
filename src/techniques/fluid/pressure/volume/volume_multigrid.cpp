// SPDX-License-Identifier: MIT
// Multigrid as in multigrid.cpp for volumes: half a sweep a pass.
#include <utility>
#include <vector>

#include "shaders/fluid_volume_coarsest_comp.hpp"
#include "shaders/fluid_volume_restrict_comp.hpp"
#include "shaders/fluid_volume_sweep_comp.hpp"
#include "shaders/fluid_volume_weights_comp.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
namespace {

struct SweepConstants {
    shared::FluidVolumeLevel level;
    shared::FluidVolumeSweep sweep;
};

uint32_t cells_of(const shared::FluidVolumeLevel& level)
{
    return level.width * level.height * level.depth;
}

/// From the grid itself to 4 x 4 x 4 cells or fewer.
std::vector<shared::FluidVolumeLevel> volume_levels(const Grid& grid)
{
    constexpr uint32_t few = 4;
    std::vector<shared::FluidVolumeLevel> levels{
        {.width = grid.cells.x, .height = grid.cells.y, .depth = grid.cells.z}};
    while (levels.back().width > few || levels.back().height > few || levels.back().depth > few) {
        const shared::FluidVolumeLevel& last = levels.back();
        levels.push_back({.width = (last.width + 1) / 2,
                          .height = (last.height + 1) / 2,
                          .depth = (last.depth + 1) / 2,
                          .first = last.first + cells_of(last)});
    }
    return levels;
}

class VolumeCycle {
public:
    VolumeCycle(gpu::Graph& graph, const Grid& grid, gpu::BufferId weights)
        : graph_(graph), bits_(grid_bits(grid)), weights_(weights), levels_(volume_levels(grid))
    {
    }

    [[nodiscard]] gpu::BufferId solve(size_t level, gpu::BufferId divergence)
    {
        if (level + 1 == levels_.size()) {
            return solve_coarsest(divergence);
        }
        gpu::BufferId pressure =
            swept(level, divergence, divergence, divergence, shared::fluid_bit_from_zero);
        const gpu::BufferId coarse = solve(level + 1, restricted(level, divergence, pressure));
        return swept(level, divergence, pressure, coarse, shared::fluid_bit_prolonging);
    }

private:
    /// Two sweeps, the first half with `first_bits`.
    [[nodiscard]] gpu::BufferId swept(size_t level, gpu::BufferId divergence, gpu::BufferId pressure,
                                      gpu::BufferId coarse_pressure, uint32_t first_bits)
    {
        const shared::FluidVolumeLevel& coarse = levels_[level + 1];
        for (uint32_t i = 0; i < 4; ++i) {
            auto pass = graph_.compute("fluid/sweep", shaders::fluid_volume_sweep_comp);
            pass.sample(divergence, gpu::Format::r32f)
                .sample(weights_, gpu::Format::rg32ui)
                .sample(pressure, gpu::Format::r32f)
                .sample(coarse_pressure, gpu::Format::r32f);
            pressure = pass.write(numbers(level));
            pass
                .push(SweepConstants{
                    .level = levels_[level],
                    .sweep = {.color = i & 1U, .coarse_width = coarse.width, .coarse_height = coarse.height}})
                .variant(bits_ | (i == 0 ? first_bits : 0U));
            dispatch_over(pass, levels_[level]);
        }
        return pressure;
    }

    [[nodiscard]] gpu::BufferId restricted(size_t level, gpu::BufferId divergence, gpu::BufferId pressure)
    {
        auto pass = graph_.compute("fluid/restrict", shaders::fluid_volume_restrict_comp);
        pass.sample(divergence, gpu::Format::r32f)
            .sample(weights_, gpu::Format::rg32ui)
            .sample(pressure, gpu::Format::r32f);
        const gpu::BufferId coarse = pass.write(numbers(level + 1));
        pass.push(levels_[level]).variant(bits_);
        dispatch_over(pass, levels_[level + 1]);
        return coarse;
    }

    [[nodiscard]] gpu::BufferId solve_coarsest(gpu::BufferId divergence)
    {
        auto pass = graph_.compute("fluid/coarsest", shaders::fluid_volume_coarsest_comp);
        pass.sample(divergence, gpu::Format::r32f).sample(weights_, gpu::Format::rg32ui);
        const gpu::BufferId pressure = pass.write(numbers(levels_.size() - 1));
        pass.push(levels_.back()).variant(bits_).dispatch(1);
        return pressure;
    }

    [[nodiscard]] gpu::BufferId numbers(size_t level)
    {
        return graph_.buffer("fluid/level",
                             {.size_bytes = sizeof(float) * uint64_t{cells_of(levels_[level])}});
    }

    static void dispatch_over(gpu::Pass& pass, const shared::FluidVolumeLevel& level)
    {
        constexpr uint32_t group = 8;
        pass.dispatch((level.width + group - 1) / group, (level.height + group - 1) / group, level.depth);
    }

    gpu::Graph& graph_;
    uint32_t bits_;
    gpu::BufferId weights_;
    std::vector<shared::FluidVolumeLevel> levels_;
};

} // namespace

uint32_t passes_of_volume_cycle(const Grid& grid)
{
    constexpr uint32_t passes_of_level = 9;
    return passes_of_level * (static_cast<uint32_t>(volume_levels(grid).size()) - 1) + 1;
}

gpu::BufferId add_volume_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids)
{
    const std::vector<shared::FluidVolumeLevel> levels = volume_levels(grid);
    const uint32_t count = levels.back().first + cells_of(levels.back());
    auto pass = graph.compute("fluid/weights", shaders::fluid_volume_weights_comp);
    pass.sample(solids.cells, gpu::Format::r32ui);
    const gpu::BufferId weights =
        pass.write(graph.buffer("fluid/weights", {.size_bytes = 2 * sizeof(uint32_t) * uint64_t{count}}));
    pass
        .push(WithGrid<shared::FluidWeights>{
            grid_constants(grid), {.level_count = static_cast<uint32_t>(levels.size()), .cell_count = count}})
        .variant(grid_bits(grid) | (solids.are_any ? shared::fluid_bit_solids : 0U))
        .dispatch_items(count);
    return weights;
}

gpu::BufferId add_volume_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation)
{
    return VolumeCycle(graph, grid, equation.weights).solve(0, equation.divergence);
}

} // namespace estampe::fluid
