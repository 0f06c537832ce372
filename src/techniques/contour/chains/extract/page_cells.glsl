// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAGE_CELLS
#define ESTAMPE_PAGE_CELLS

// The page lattice: a grid on the page with a point every cell_px pixels. A line may cross the side between
// two neighbouring points; each point stores two words, for the sides from the point to the right and
// downwards. The cell of a point lies to the right of and below the point. Points at the right and lower
// border of the page have no cell. Requires before inclusion: `constants`, a CellConstants.

// Where a line crosses a side of the lattice: the position along the side, which may be slightly beyond the
// side's ends. Also stores whether the tested quantity (for example the visible share of the sun) increases
// along the side.
struct Crossing {
    bool is_there;
    bool rises;
    // The crossing lies on the surface seen at the middle of the side, not at the start of the side.
    bool is_seen_between;
    float share;
};

uint pack_crossing(Crossing crossing)
{
    uint flags =
        (crossing.rises ? crossing_rises : 0u) | (crossing.is_seen_between ? crossing_seen_between : 0u);
    uint share = uint(clamp(16384.0 * (crossing.share + 1.0) + 0.5, 0.0, 65535.0));
    return crossing.is_there ? crossing_is_there | flags | share : 0u;
}

Crossing unpack_crossing(uint word)
{
    return Crossing((word & crossing_is_there) != 0u, (word & crossing_rises) != 0u,
                    (word & crossing_seen_between) != 0u, float(word & 0xffffu) / 16384.0 - 1.0);
}

ivec2 pixel_of_point(uvec2 point)
{
    return ivec2(cell_px * point);
}

// Integer division is slow on CPUs. The row is computed as a quotient of floats, which is wrong by at most
// one row, and then corrected.
uvec2 point_of_cell(uint cell)
{
    uint row = uint(float(cell) / float(constants.columns));
    row -= row * constants.columns > cell ? 1u : 0u;
    row += cell - row * constants.columns >= constants.columns ? 1u : 0u;
    return uvec2(cell - row * constants.columns, row);
}

#endif
