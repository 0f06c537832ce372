// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_GRID
#define ESTAMPE_SAMPLE_GRID

#include "shaders/loops.glsl"

// The sample grid divides the page into cells of a few pixels. Each cell stores only the samples with the
// lowest and the highest index, so at most two lines are found per cell. Requires before inclusion:
// GRID_BINDING, GRID_ACCESS.

layout(scalar, binding = GRID_BINDING) GRID_ACCESS buffer Grid
{
    // For each cell: the lowest sample index, and the highest sample index plus one; zero if empty.
    uvec2 grid[];
};

uvec2 grid_size(uvec2 size_px)
{
    return (size_px + grid_cell_px - 1u) / grid_cell_px;
}

ivec2 cell_of(vec2 page_px, uvec2 size_px)
{
    return clamp(ivec2(floor(page_px / float(grid_cell_px))), ivec2(0), ivec2(grid_size(size_px)) - 1);
}

uint cell_index(ivec2 cell, uvec2 size_px)
{
    return uint(cell.y) * grid_size(size_px).x + uint(cell.x);
}

// The range of grid cells that contains the cell of a place on the page and its neighbours.
Cells cells_around(vec2 page_px, uvec2 size_px)
{
    ivec2 cell = cell_of(page_px, size_px);
    return Cells(max(cell - 1, ivec2(0)), min(cell + 1, ivec2(grid_size(size_px)) - 1));
}

#endif
