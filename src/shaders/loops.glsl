// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOOPS
#define ESTAMPE_LOOPS

// Numbers of threads, and loops that compilers are to leave loops.

// The number of this thread's item, for dispatches that may need more workgroups than one direction allows.
// They are of 64 threads; gl_WorkGroupSize would be 1 before a shader has said so.
uint item_index()
{
    return gl_GlobalInvocationID.y * (64u * gl_NumWorkGroups.x) + gl_GlobalInvocationID.x;
}

// `count`, for loops that are to stay loops: what is in them is compiled once, as the compiler does not know
// that `not_negative` is that, and so not how often they run.
int loop_rounds(int count, int not_negative)
{
    return count + min(not_negative, 0);
}

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
