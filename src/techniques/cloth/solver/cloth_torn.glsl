// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_TORN
#define ESTAMPE_CLOTH_TORN

// Torn links of a cloth sheet: 64 bits per particle, one per link. In a sheet with lists of links, link
// number k has bit number k. On a grid, the function link_bit() gives the bit of a link. The four grid cells
// around a particle also have bits, set if any link of the cell is torn.
//
// Requires: uvec2 torn_of(uint local).

#include "techniques/cloth/cloth_data.glsl"

const bool may_tear = (variant & cloth_bit_tear) != 0u;

bool has_bit(uvec2 torn, uint bit)
{
    return (torn[bit / 32u] >> (bit % 32u) & 1u) != 0u;
}

uint link_bit(ivec2 way)
{
    return uint(5 * (way.y + 2) + way.x + 2);
}

uint cell_bit(ivec2 way)
{
    return cloth_torn_cells + (way.x > 0 ? 1u : 0u) + (way.y > 0 ? 2u : 0u);
}

// Weight of a link: 0 if the link is torn, else 1.
float whole_link(uvec2 torn, int x, int y)
{
    return may_tear && has_bit(torn, link_bit(ivec2(x, y))) ? 0.0 : 1.0;
}

float whole_cell(uvec2 torn, int x, int y)
{
    return may_tear && has_bit(torn, cell_bit(ivec2(x, y))) ? 0.0 : 1.0;
}

uvec4 link_at(uint local, uint k)
{
    return texelFetch(link_texels, int(sheet.first_link + k * sheet.stride + local));
}

// Whether the link between two neighbour particles is torn, in a sheet with lists of links.
bool is_torn_between(uint local, uint other)
{
    uvec2 torn = torn_of(local);
    bool is_torn = false;
    for (uint k = 0u; k < (torn == uvec2(0u) ? 0u : sheet.link_width); ++k) {
        is_torn = is_torn || (has_bit(torn, k) && link_at(local, k).x == other);
    }
    return is_torn;
}

bool is_torn_face(uint local, uvec2 others)
{
    return may_tear && (is_torn_between(local, others.x) || is_torn_between(local, others.y) ||
                        is_torn_between(others.x, others.y));
}

#endif
