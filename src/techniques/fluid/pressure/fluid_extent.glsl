// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_EXTENT
#define ESTAMPE_FLUID_EXTENT

// Width of cell `i` of a multigrid level with `size` cells, in units of the level's usual cell width. The
// last cell covers only the rest of the grid.
float extent(int i, int size, int level, int cells)
{
    return i < size - 1 ? 1.0 : float(cells) / float(1 << level) - float(size - 1);
}

// Ratio of a cell's width to the distance between the cell's centre and the centre of the previous cell.
float nearness(int i, int size, int level, int cells)
{
    int before = i == 0 ? size - 1 : i - 1;
    return 2.0 / (extent(i, size, level, cells) + extent(before, size, level, cells));
}

#endif
