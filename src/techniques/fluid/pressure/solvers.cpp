// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/solvers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "gpu/resources.hpp"
#include "shaders/fluid_down_comp.hpp"
#include "shaders/fluid_rows_comp.hpp"
#include "shaders/fluid_small_comp.hpp"
#include "shaders/fluid_up_comp.hpp"
#include "shaders/fluid_volume_coarsest_comp.hpp"
#include "shaders/fluid_volume_restrict_comp.hpp"
#include "shaders/fluid_volume_sweep_comp.hpp"
#include "shaders/fluid_volume_weights_comp.hpp"

namespace estampe::fluid {
namespace {

shared::FluidLevel coarser(const shared::FluidLevel& level)
{
    return {.width = (level.width + 1) / 2,
            .height = (level.height + 1) / 2,
            .first = level.first + cell_count(level)};
}

/// Number of multigrid levels from `level` down to a level of four cells or fewer.
uint32_t small_levels_from(const shared::FluidLevel& level)
{
    constexpr uint32_t few_cells = 4;
    uint32_t count = 1;
    for (shared::FluidLevel last = level; cell_count(last) > few_cells; last = coarser(last)) {
        ++count;
    }
    return count;
}

} // namespace

std::vector<shared::FluidLevel> levels_of(const Grid& grid)
{
    std::vector<shared::FluidLevel> levels{{.width = grid.cells.x, .height = grid.cells.y, .first = 0}};
    while (cell_count(levels.back()) > shared::fluid_small_cells) {
        levels.push_back(coarser(levels.back()));
    }
    return levels;
}

// Geometric multigrid with aggregated cells: the pressure of a coarse cell is added unchanged to the four
// finer cells, and the residuals of the four cells are summed. Each level is smoothed by two red-black sweeps
// before and two sweeps after the coarser levels. On each large level, the way down is one pass and the way
// up is one pass; both work in tiles. All small levels together are one pass. Source: Trottenberg, Oosterlee
// and Schüller, "Multigrid", 2001; on over-correction of aggregates, Braess, "Towards algebraic multigrid for
// elliptic problems of second order", Computing 55, 1995.

namespace {

struct Descended {
    gpu::BufferId pressure;
    gpu::BufferId coarse_divergence;
};

class VCycle {
public:
    VCycle(gpu::Graph& graph, const Grid& grid, gpu::BufferId weights)
        : graph_(graph), bits_(grid_bits(grid)), weights_(weights), levels_(levels_of(grid))
    {
    }

    [[nodiscard]] gpu::BufferId solve(size_t level, gpu::BufferId divergence)
    {
        if (level + 1 == levels_.size()) {
            return solve_small(divergence);
        }
        const Descended down = descend(level, divergence);
        const gpu::BufferId coarse_pressure = solve(level + 1, down.coarse_divergence);
        auto pass = graph_.compute("fluid/up", shaders::fluid_up_comp);
        pass.sample(divergence, gpu::Format::r32f)
            .sample(weights_, gpu::Format::r32ui)
            .sample(down.pressure, gpu::Format::r32f)
            .sample(coarse_pressure, gpu::Format::r32f);
        const gpu::BufferId pressure = pass.write(numbers("fluid/pressure", level));
        pass.push(tile_of(level)).variant(bits_);
        dispatch_over_tiles(pass, level);
        return pressure;
    }

private:
    [[nodiscard]] Descended descend(size_t level, gpu::BufferId divergence)
    {
        auto pass = graph_.compute("fluid/down", shaders::fluid_down_comp);
        pass.sample(divergence, gpu::Format::r32f).sample(weights_, gpu::Format::r32ui);
        const gpu::BufferId pressure = pass.write(numbers("fluid/smoothed", level));
        const gpu::BufferId coarse = pass.write(numbers("fluid/residual", level + 1));
        pass.push(tile_of(level)).variant(bits_);
        dispatch_over_tiles(pass, level);
        return {pressure, coarse};
    }

    [[nodiscard]] gpu::BufferId solve_small(gpu::BufferId divergence)
    {
        const shared::FluidLevel& level = levels_.back();
        auto pass = graph_.compute("fluid/small", shaders::fluid_small_comp);
        pass.sample(divergence, gpu::Format::r32f).sample(weights_, gpu::Format::r32ui);
        const gpu::BufferId pressure = pass.write(numbers("fluid/pressure", levels_.size() - 1));
        pass.push(shared::FluidSmall{.level = level,
                                     .level_count = small_levels_from(level),
                                     .level_number = static_cast<uint32_t>(levels_.size() - 1),
                                     .width = levels_[0].width,
                                     .height = levels_[0].height})
            .variant(bits_)
            .dispatch(1);
        return pressure;
    }

    [[nodiscard]] shared::FluidTile tile_of(size_t level) const
    {
        return {.level = levels_[level], .coarse = levels_[level + 1], .rounds = 0};
    }

    [[nodiscard]] gpu::BufferId numbers(const char* name, size_t level)
    {
        return graph_.buffer(name, {.size_bytes = sizeof(float) * uint64_t{cell_count(levels_[level])}});
    }

    void dispatch_over_tiles(gpu::Pass& pass, size_t level) const
    {
        const auto tiles = [](uint32_t cells) { return (cells - 1) / shared::fluid_tile + 1; };
        pass.dispatch(tiles(levels_[level].width), tiles(levels_[level].height));
    }

    gpu::Graph& graph_;
    uint32_t bits_;
    gpu::BufferId weights_;
    std::vector<shared::FluidLevel> levels_;
};

} // namespace

gpu::BufferId add_v_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation)
{
    return VCycle(graph, grid, equation.weights).solve(0, equation.divergence);
}

// The multigrid method in 3D, where each half sweep is one pass.

namespace {

struct SweepConstants {
    shared::FluidVolumeLevel level;
    shared::FluidVolumeSweep sweep;
};

uint32_t cells_of(const shared::FluidVolumeLevel& level)
{
    return level.width * level.height * level.depth;
}

/// Multigrid levels from the grid down to 4 x 4 x 4 cells or fewer.
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
    /// Adds two smoothing sweeps of a multigrid level. `first_bits` are added to `variant` in the first half
    /// sweep.
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

namespace {

uint32_t log_of(uint32_t power_of_two)
{
    return static_cast<uint32_t>(std::countr_zero(power_of_two));
}

uint32_t log_turn_of(const Grid& grid)
{
    return 2 + log_of(std::max({grid.cells.x, grid.cells.y, grid.cells.z}));
}

uint32_t axis_bit(uint32_t axis)
{
    return axis == 2 ? shared::fluid_bit_along_z : axis == 1 ? shared::fluid_bit_along_y : 0U;
}

class Transform {
public:
    Transform(gpu::Graph& graph, const Grid& grid, gpu::BufferId angles)
        : graph_(graph), grid_(grid), angles_(angles)
    {
    }

    [[nodiscard]] gpu::BufferId add(const char* name, gpu::BufferId numbers, uint32_t axis, uint32_t bits)
    {
        const uint32_t length = grid_.cells[static_cast<int>(axis)];
        const auto pairs = static_cast<uint32_t>(grid_.cell_count() / length / 2);
        // Most row pairs per workgroup: eight pairs side by side read 64 contiguous bytes; more than eight
        // pairs would leave too few workgroups.
        constexpr uint32_t most_at_once = 8;
        const uint32_t at_once =
            std::min(std::clamp(shared::fluid_transform_pairs / length, 1U, pairs), most_at_once);
        auto pass = graph_.compute(name, shaders::fluid_rows_comp);
        pass.sample(numbers, gpu::Format::r32f).sample(angles_, gpu::Format::rg32ui);
        const gpu::BufferId out =
            pass.write(graph_.buffer("fluid/waves", {.size_bytes = sizeof(float) * grid_.cell_count()}));
        pass.push(shared::FluidTransform{.width = grid_.cells.x,
                                         .height = grid_.cells.y,
                                         .depth = grid_.cells.z,
                                         .log_length = log_of(length),
                                         .log_pairs = log_of(at_once),
                                         .log_turn = log_turn_of(grid_),
                                         .share = 1.0F / static_cast<float>(length)})
            .variant(grid_bits(grid_) | bits | axis_bit(axis) |
                     (length > shared::fluid_transform_pairs ? shared::fluid_bit_long : 0U))
            .dispatch(pairs / at_once);
        return out;
    }

private:
    gpu::Graph& graph_;
    const Grid& grid_;
    gpu::BufferId angles_;
};

} // namespace

bool is_spectral_possible(const Grid& grid)
{
    return std::has_single_bit(grid.cells.x) && std::has_single_bit(grid.cells.y) &&
           std::has_single_bit(grid.cells.z);
}

gpu::Buffer upload_angles(gpu::Device& device, const Grid& grid)
{
    std::vector<glm::vec2> angles(is_spectral_possible(grid) ? size_t{1} << log_turn_of(grid) : 1);
    for (size_t i = 0; i < angles.size(); ++i) {
        const double turned =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(angles.size());
        angles[i] = glm::vec2(std::cos(turned), std::sin(turned));
    }
    return gpu::upload_buffer(device, "fluid angles", angles);
}

gpu::BufferId add_spectral(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                           gpu::BufferId angles)
{
    Transform transform(graph, grid, angles);
    const uint32_t last = grid.dimensions() - 1;
    gpu::BufferId waves = equation.divergence;
    for (uint32_t axis = 0; axis < last; ++axis) {
        waves = transform.add("fluid/transform", waves, axis, 0);
    }
    waves = transform.add("fluid/divide", waves, last, shared::fluid_bit_dividing);
    for (uint32_t axis = last; axis > 0; --axis) {
        waves = transform.add("fluid/transform back", waves, axis - 1, shared::fluid_bit_reversed);
    }
    return waves;
}

} // namespace estampe::fluid
