// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VISIBILITY
#define ESTAMPE_VISIBILITY

// A visibility buffer has one 64-bit word per pixel, here read as two halves: the triangle number in the low
// half, reversed depth in the high half. Triangles never have depth zero; depth zero means that the pixel is
// empty.

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
