// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_GRID
#define ESTAMPE_SAMPLE_GRID

// The page in cells of a few pixels: each knows the first and the last of the samples in it. Of more than two
// lines in one cell, two are found. Wanted before: GRID_BINDING, GRID_ACCESS.

layout(scalar, binding = GRID_BINDING) GRID_ACCESS buffer Grid
{
    uvec2 grid[]; // lowest sample; one more than the highest
};

uvec2 grid_size(uvec2 size_px)
{
    return (size_px + GRID_CELL_PX - 1u) / GRID_CELL_PX;
}

// The cell at a place of the page, or one of those around it.
uint cell_at(vec2 page_px, ivec2 step, uvec2 size_px)
{
    ivec2 cells = ivec2(grid_size(size_px));
    ivec2 cell = clamp(ivec2(floor(page_px / float(GRID_CELL_PX))) + step, ivec2(0), cells - 1);
    return uint(cell.y * cells.x + cell.x);
}

#endif
