// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLAB_LINES
#define ESTAMPE_SLAB_LINES

// Lines of cells along the wind, on a field that repeats at its edges. With n cells per side, n lines of n
// steps visit each cell once. After n steps, each line continues as another line. Cells in the lee lie below
// a roof, an imaginary surface that descends downwind from every crest. The including shader must declare
// `slab`, a SlabConstants, and last_slabs.

const int no_roof = -0x40000000;

uint slab_cell(ivec2 place)
{
    ivec2 wrapped = place & (int(slab.side) - 1);
    return uint(wrapped.y) * slab.side + uint(wrapped.x);
}

uint cell_of_line(int line, int step)
{
    int along = slab.sign * step;
    int across = line + ((slab.slope * step + slab.phase) >> 16);
    return slab_cell(slab.along_y != 0u ? ivec2(across, along) : ivec2(along, across));
}

// The number of the line of cells that continues as the line `line`, on its upwind side.
int line_upwind(int line)
{
    return (line - ((slab.slope * int(slab.side)) >> 16)) & (int(slab.side) - 1);
}

int steps_of_piece()
{
    return int(slab.side / slab_pieces);
}

uint number_of_piece(int line, int piece)
{
    return uint(line) * slab_pieces + uint(piece);
}

// Converts a number of slabs (units of sand) to 1/256 slab. The lee's roof (an imaginary surface that
// descends downwind from each crest) is stored in 1/256 slab.
int height_of(uint slabs)
{
    return int(slabs) << 8;
}

#endif
