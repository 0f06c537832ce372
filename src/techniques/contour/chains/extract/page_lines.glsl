// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAGE_LINES
#define ESTAMPE_PAGE_LINES

// Finds the cells of the page lattice (a grid of points on the page) through which exactly one line runs.
// Requires before inclusion: CROSSINGS_BINDING and page_cells.glsl.

layout(binding = CROSSINGS_BINDING) uniform usamplerBuffer crossing_texels;

// One of the four sides of a cell, in clockwise order on the page.
struct CellSide {
    uvec2 point;
    bool is_down;
    bool is_backwards;
};

CellSide cell_side(uvec2 cell, uint side)
{
    return CellSide(cell + uvec2(side == 1u ? 1u : 0u, side == 2u ? 1u : 0u), (side & 1u) != 0u, side >= 2u);
}

uvec2 crossing_words(uvec2 point)
{
    return texelFetch(crossing_texels, int(point.y * constants.columns + point.x)).xy;
}

Crossing crossing_at(CellSide side)
{
    uvec2 words = crossing_words(side.point);
    return unpack_crossing(side.is_down ? words.y : words.x);
}

// The sides of a cell at which a line enters and leaves. The line enters at the side on which the tested
// quantity increases in the clockwise direction.
struct CellLine {
    bool is_there;
    uint from;
    uint to;
};

// The line through a cell that has exactly one entering and one leaving side. All cells without exactly one
// entering and one leaving side have no line.
CellLine line_through(uvec2 cell)
{
    uvec2 here = crossing_words(cell);
    uvec4 sides =
        uvec4(here.x, crossing_words(cell + uvec2(1u, 0u)).y, crossing_words(cell + uvec2(0u, 1u)).x, here.y);
    uvec4 is_there = min(sides & crossing_is_there, uvec4(1u));
    // The lower and the left side of a cell are stored in the opposite direction, so the sides' direction
    // bits are inverted.
    uvec4 is_rise = min(sides & crossing_rises, uvec4(1u)) ^ uvec4(0u, 0u, 1u, 1u);
    uvec4 rise = is_there & is_rise;
    uvec4 fall = is_there & ~is_rise;
    bool is_one = rise.x + rise.y + rise.z + rise.w == 1u && fall.x + fall.y + fall.z + fall.w == 1u;
    // A mark does not go on as an outline.
    uvec4 is_mark = is_there & min(sides & crossing_is_mark, uvec4(1u));
    uint marks = is_mark.x + is_mark.y + is_mark.z + is_mark.w;
    return CellLine(is_one && (marks == 0u || marks == 2u), rise.y + 2u * rise.z + 3u * rise.w,
                    fall.y + 2u * fall.z + 3u * fall.w);
}

#endif
