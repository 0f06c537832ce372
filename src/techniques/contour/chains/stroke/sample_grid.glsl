// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_GRID
#define ESTAMPE_SAMPLE_GRID

#include "shaders/loops.glsl"

// The page as a grid of cells of a few pixels. Each cell stores the first and last of its samples, so at most
// two lines per cell are found. Requires before inclusion: GRID_BINDING, GRID_ACCESS.

layout(scalar, binding = GRID_BINDING) GRID_ACCESS buffer Grid
{
    uvec2 grid[]; // the lowest sample, and one more than the highest
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

// The cell at a place of the page and its neighbours.
Cells cells_around(vec2 page_px, uvec2 size_px)
{
    ivec2 cell = cell_of(page_px, size_px);
    return Cells(max(cell - 1, ivec2(0)), min(cell + 1, ivec2(grid_size(size_px)) - 1));
}

#endif
