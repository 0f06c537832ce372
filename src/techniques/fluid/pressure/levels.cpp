// SPDX-License-Identifier: MIT
#include "techniques/fluid/pressure/levels.hpp"

namespace estampe::fluid {
namespace {

shared::FluidLevel coarser(const shared::FluidLevel& level)
{
    return {.width = (level.width + 1) / 2,
            .height = (level.height + 1) / 2,
            .first = level.first + cell_count(level)};
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

uint32_t small_levels_from(const shared::FluidLevel& level)
{
    constexpr uint32_t few_cells = 4;
    uint32_t count = 1;
    for (shared::FluidLevel last = level; cell_count(last) > few_cells; last = coarser(last)) {
        ++count;
    }
    return count;
}

} // namespace estampe::fluid
