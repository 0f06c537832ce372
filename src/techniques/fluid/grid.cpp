// SPDX-License-Identifier: MIT
#include "techniques/fluid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace estampe::fluid {

void check_grid(const Grid& grid)
{
    const auto is_within = [](uint32_t cells, uint32_t most) { return cells >= 4 && cells <= most; };
    if (!is_within(grid.cells.x, 4096) || !is_within(grid.cells.y, 4096) ||
        (grid.cells.z != 1 && !is_within(grid.cells.z, 256))) {
        throw std::logic_error("a grid of fluid has 4 to 4096 cells along x and y, along z 1 or 4 to 256");
    }
    if (!(grid.cell_m > 0.0F) || !std::isfinite(grid.cell_m)) {
        throw std::logic_error("a cell of fluid has a side of more than 0 metres");
    }
}

shared::FluidGrid grid_constants(const Grid& grid)
{
    return {.width = grid.cells.x,
            .height = grid.cells.y,
            .depth = grid.cells.z,
            .texel_x = 1.0F / static_cast<float>(grid.cells.x),
            .texel_y = 1.0F / static_cast<float>(grid.cells.y),
            .lid_speed = {grid.lid_m_per_s.x, 0.0F, grid.lid_m_per_s.z}};
}

uint32_t grid_bits(const Grid& grid)
{
    uint32_t bits = grid.is_volume() ? shared::fluid_bit_volume : 0U;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        bits |= grid.edges[axis] == Edge::periodic    ? shared::fluid_bit_periodic << axis
                : grid.edges[axis] == Edge::free_slip ? shared::fluid_bit_free_slip << axis
                                                      : 0U;
    }
    return bits;
}

gpu::ImageDesc field_desc(const Grid& grid, uint32_t channels)
{
    return {.width = grid.cells.x,
            .height = grid.cells.y,
            .format = gpu::Format::r32f,
            .layers = std::max(channels * grid.cells.z, 2U)};
}

gpu::ImageDesc velocity_desc(const Grid& grid)
{
    return field_desc(grid, grid.dimensions());
}

gpu::ImageDesc vectors_desc(const Grid& grid, uint32_t sets)
{
    gpu::ImageDesc desc = field_desc(grid, sets);
    desc.format = gpu::Format::rgba16f;
    return desc;
}

void dispatch_over_cells(gpu::Pass& pass, const Grid& grid)
{
    constexpr uint32_t group = 8;
    pass.dispatch((grid.cells.x + group - 1) / group, (grid.cells.y + group - 1) / group, grid.cells.z);
}

} // namespace estampe::fluid
