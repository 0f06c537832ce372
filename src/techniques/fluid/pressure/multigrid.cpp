// SPDX-License-Identifier: MIT
// Geometric multigrid with aggregated cells: pressures of a coarse cell are added to its four cells as they
// are, what is left of their equations is summed. Smoothing is by red and black sweeps, two before and two
// after. Way down and way up of a level are one pass each, in tiles; all small levels together are one.
// Source: Trottenberg, Oosterlee and Schüller, "Multigrid", 2001; on over-correction of aggregates, Braess,
// "Towards algebraic multigrid for elliptic problems of second order", Computing 55, 1995.
#include "shaders/fluid_down_comp.hpp"
#include "shaders/fluid_small_comp.hpp"
#include "shaders/fluid_up_comp.hpp"
#include "techniques/fluid/pressure/levels.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace estampe::fluid {
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

} // namespace estampe::fluid
