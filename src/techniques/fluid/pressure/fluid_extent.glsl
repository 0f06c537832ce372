// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_EXTENT
#define ESTAMPE_FLUID_EXTENT

// How wide cell `i` of `size` is, in cells of its level: the last one has what is left of the grid's `cells`.
float extent(int i, int size, int level, int cells)
{
    return i < size - 1 ? 1.0 : float(cells) / float(1 << level) - float(size - 1);
}

// How much closer than a cell's width the middles of cell `i` and the one before it are, as a factor.
float nearness(int i, int size, int level, int cells)
{
    int before = i == 0 ? size - 1 : i - 1;
    return 2.0 / (extent(i, size, level, cells) + extent(before, size, level, cells));
}

#endif
