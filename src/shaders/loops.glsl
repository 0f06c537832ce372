// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOOPS
#define ESTAMPE_LOOPS

// Thread indices, and loops that the compiler must not unroll.

// Index of this thread's item, for dispatches whose number of workgroups may exceed the limit of one
// dimension. Workgroups have 64 threads; gl_WorkGroupSize would be 1 before the shader declares it.
uint item_index()
{
    return gl_GlobalInvocationID.y * (64u * gl_NumWorkGroups.x) + gl_GlobalInvocationID.x;
}

// Returns `count`, as a loop bound that prevents unrolling, so that the loop body is compiled once. The
// compiler does not know that `not_negative` is never negative, so it cannot know the number of rounds.
int loop_rounds(int count, int not_negative)
{
    return count + min(not_negative, 0);
}

// A rectangle of cells or pixels, with both ends included, for one loop over all rows. The size of the
// rectangle is unknown at compile time, which prevents unrolling, so the loop body is compiled once.

struct Cells {
    ivec2 low;
    ivec2 high;
};

ivec2 next_cell(ivec2 cell, Cells cells)
{
    return cell.x < cells.high.x ? ivec2(cell.x + 1, cell.y) : ivec2(cells.low.x, cell.y + 1);
}

#endif
