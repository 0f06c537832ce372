// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CELLS
#define ESTAMPE_CELLS

// A rectangle of cells or pixels, both ends within it, to be gone through row by row in one loop. As its size
// is not known before, compilers leave the loop a loop: what is in it is compiled once.

struct Cells {
    ivec2 low;
    ivec2 high;
};

ivec2 next_cell(ivec2 cell, Cells cells)
{
    return cell.x < cells.high.x ? ivec2(cell.x + 1, cell.y) : ivec2(cells.low.x, cell.y + 1);
}

#endif
