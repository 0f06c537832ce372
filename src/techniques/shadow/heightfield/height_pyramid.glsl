// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_PYRAMID
#define ESTAMPE_HEIGHT_PYRAMID

// Where a cell of a level stands in the pyramid's image; see height_shadow.glsl.h.

ivec2 cells_of_level(uint level)
{
    return (ivec2(pyramid.cells) + (1 << level) - 1) >> level;
}

ivec2 place_of_cell(ivec2 cell, uint level)
{
    return level == 0u ? cell
                       : cell + ivec2(pyramid.cells.x, int(pyramid.rows - (pyramid.rows >> (level - 1u))));
}

#endif
