// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLABS_GLSL_H
#define ESTAMPE_SLABS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// What the wind finds in a cell.
SHARED_CONSTANT uint slab_open_sand = 0U;
SHARED_CONSTANT uint slab_open_rock = 1U; // no sand left
SHARED_CONSTANT uint slab_in_lee = 2U;

SHARED_CONSTANT uint slab_most_hops = 32U; // where the last one ends, the slab stays

// A line of cells along the wind is walked in so many pieces, each by a thread.
SHARED_CONSTANT uint slab_pieces = 16U;

// All that moves sand is whole numbers, alike on every device.
struct SlabConstants {
    uint side; // cells, a power of two
    uint step; // counted from the field's beginning
    uint seed;
    uint along_y; // 1: lines of the wind step along y, else along x
    int sign;     // of that step
    int slope;    // cells across for a step along, times 65536; over the whole side it is whole cells
    int phase;    // where lines round, times 65536
    int drop;     // of the lee's roof over a step, 1/256 slab
    int hop_x;    // of a slab, 1/256 cell
    int hop_y;
    int mean;     // height at which hops are that long, slabs
    int gain;     // of a hop's length by a slab of height, times 65536
    uint lift;    // of 65536 cells, those that the wind tries in a step
    uint on_sand; // of 65536 slabs that touch sand, those that stay
    uint on_rock;
};

// A phase of the sliding looks at blocks of two by two cells; the next phase's blocks lie elsewhere.
struct SlideConstants {
    uint side;
    uint first_x; // 0 or 1: where blocks begin
    uint first_y;
    int beside; // slabs that a cell may be higher than the one beside it
    int aslant; // the same across a corner
};

struct SlabHeightConstants {
    uint side;
    uint radius; // cells that are smoothed over, on either side
    float slab_m;
    float fraction; // from the state before the last step, 0, to the last, 1
};

#ifdef __cplusplus
static_assert(sizeof(SlabConstants) == 60);
} // namespace estampe::shared
#endif

#endif
