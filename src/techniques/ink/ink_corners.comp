// SPDX-License-Identifier: MIT
// One thread per cell of ink packs the ink that the drawing gives in four cells into one word: the thread's
// cell, its neighbours to the right and below, and the cell diagonally below. With these words, the steps of
// the ink interpolate between cells with a single read.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 1) uniform usamplerBuffer source_texels; // given ink and rank of spots, see ink_source.comp

layout(scalar, binding = 2) writeonly buffer Corners
{
    uint corners[];
};

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(globals.grid_size);
    if (any(greaterThanEqual(cell, size))) {
        return;
    }
    uint word = 0u;
    vec2 strongest = vec2(0.0, 1.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 at = min(cell + ivec2(i & 1, i >> 1), size - 1);
        vec2 source = unpackUnorm4x8(texelFetch(source_texels, at.y * size.x + at.x).x).xy;
        word |= uint(source.x * float(ink_corner_most) + 0.5) << (ink_corner_bits * uint(i));
        strongest = source.x > strongest.x ? source : strongest;
    }
    corners[cell.y * size.x + cell.x] = word | uint(strongest.y * 255.0 + 0.5) << ink_rank_shift;
}
