// SPDX-License-Identifier: MIT
// One thread handles one block of 2 x 2 cells. Sand slides between the cells of the block where it is steeper
// than its angle of repose. Blocks do not overlap, so the heights can be changed in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) buffer Slabs
{
    uint slabs[];
};

layout(push_constant, scalar) uniform Constants
{
    SlideConstants slide;
};

// Number of slabs (units of sand) that slide from the higher of two cells to the lower cell. The number is
// half of the excess of height over the allowed difference, rounded up.
int sliding(int from, int to, int most)
{
    int difference = from - to;
    int moved = max(abs(difference) - most + 1, 0) >> 1;
    return difference < 0 ? -moved : moved;
}

void main()
{
    uvec2 block = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(block, uvec2(slide.side / 2u)))) {
        return;
    }
    uint last = slide.side - 1u;
    uvec2 near = 2u * block + uvec2(slide.first_x, slide.first_y);
    uvec2 far = (near + 1u) & last;
    uint at[4] = {near.y * slide.side + near.x, near.y * slide.side + far.x, far.y * slide.side + near.x,
                  far.y * slide.side + far.x};
    ivec4 before = ivec4(slabs[at[0]], slabs[at[1]], slabs[at[2]], slabs[at[3]]);
    ivec4 h = before;
    int moved = sliding(h.x, h.w, slide.aslant);
    h.x -= moved;
    h.w += moved;
    moved = sliding(h.y, h.z, slide.aslant);
    h.y -= moved;
    h.z += moved;
    moved = sliding(h.x, h.y, slide.beside);
    h.x -= moved;
    h.y += moved;
    moved = sliding(h.z, h.w, slide.beside);
    h.z -= moved;
    h.w += moved;
    moved = sliding(h.x, h.z, slide.beside);
    h.x -= moved;
    h.z += moved;
    moved = sliding(h.y, h.w, slide.beside);
    h.y -= moved;
    h.w += moved;
    if (h != before) {
        slabs[at[0]] = uint(h.x);
        slabs[at[1]] = uint(h.y);
        slabs[at[2]] = uint(h.z);
        slabs[at[3]] = uint(h.w);
    }
}
