// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRIANGLE_SIDES
#define ESTAMPE_TRIANGLE_SIDES

// Sides of triangles, in the sense of their shell. Wanted before: mesh_texels.glsl and `neighbor_texels`.

uint next_corner(uint corner)
{
    return corner == 2u ? 0u : corner + 1u;
}

// Whether a triangle's corners run clockwise as seen from its front.
bool is_reversed(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & NEIGHBOR_IS_TURNED) != 0u;
    return is_turned != ((triangle_at(triangle).w & TRIANGLE_MIRRORED) != 0u);
}

// The corners where a side starts and ends, with fronts on its left.
uvec2 ends_of(uint side)
{
    uint first = side & 3u;
    bool reversed = is_reversed(side >> 2);
    return reversed ? uvec2(next_corner(first), first) : uvec2(first, next_corner(first));
}

#endif
