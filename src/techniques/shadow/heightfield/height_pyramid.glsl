// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_PYRAMID
#define ESTAMPE_HEIGHT_PYRAMID

// Positions of a pyramid level's cells and of texels in the height field of the calling thread; see
// height_shadow.glsl.h.

ivec2 cells_of_level(uint level)
{
    return (ivec2(pyramid.cells) + (1 << level) - 1) >> level;
}

ivec2 place_of_cell(ivec2 cell, uint level)
{
    ivec2 first =
        level == 0u ? ivec2(0) : ivec2(pyramid.cells.x, pyramid.rows - (pyramid.rows >> (level - 1u)));
    return cell + first + ivec2(0, gl_GlobalInvocationID.z * pyramid.rows);
}

ivec2 place_of_texel(ivec2 texel)
{
    return texel + ivec2(0, gl_GlobalInvocationID.z * (pyramid.cells.y + 1u));
}

#endif
