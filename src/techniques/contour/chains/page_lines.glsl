// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAGE_LINES
#define ESTAMPE_PAGE_LINES

#include "shaders/rounds.glsl"

// Cells through which one line runs. Wanted before: CROSSINGS_BINDING and page_cells.glsl.

layout(binding = CROSSINGS_BINDING) uniform usamplerBuffer crossing_texels;

// A side of a cell, gone along clockwise on the page.
struct CellSide {
    uvec2 point;
    bool is_down;
    bool is_backwards;
};

CellSide cell_side(uvec2 cell, uint side)
{
    return CellSide(cell + uvec2(side == 1u ? 1u : 0u, side == 2u ? 1u : 0u), (side & 1u) != 0u, side >= 2u);
}

Crossing crossing_at(CellSide side)
{
    uvec2 words = texelFetch(crossing_texels, int(side.point.y * constants.columns + side.point.x)).xy;
    return unpack_crossing(side.is_down ? words.y : words.x);
}

// The sides where the line comes in, as what it divides rises there, and where it goes out.
struct CellLine {
    bool is_there;
    uint from;
    uint to;
};

// A cell through which one line runs has one side of either sort; all others are left out.
CellLine line_through(uvec2 cell)
{
    uint rises = 0u;
    uint falls = 0u;
    for (int side = 0; side < rounds(4, int(constants.columns)); ++side) {
        CellSide along = cell_side(cell, uint(side));
        Crossing crossing = crossing_at(along);
        uint bit = crossing.is_there ? 1u << side : 0u;
        bool is_rise = crossing.rises != along.is_backwards;
        rises |= is_rise ? bit : 0u;
        falls |= is_rise ? 0u : bit;
    }
    bool is_one = bitCount(rises) == 1 && bitCount(falls) == 1;
    return CellLine(is_one, uint(max(findLSB(rises), 0)), uint(max(findLSB(falls), 0)));
}

#endif
