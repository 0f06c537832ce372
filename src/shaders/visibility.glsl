// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VISIBILITY
#define ESTAMPE_VISIBILITY

// A visibility buffer holds one 64-bit word a pixel, read here as two halves: the triangle, and reversed
// depth above it. Depth zero, which no triangle has, means that nothing is there.

bool sees_triangle(uvec2 word)
{
    return word.y != 0u;
}

uint seen_triangle(uvec2 word)
{
    return word.x;
}

float seen_depth(uvec2 word)
{
    return uintBitsToFloat(word.y);
}

#endif
