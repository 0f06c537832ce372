// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DARK_TILES
#define ESTAMPE_DARK_TILES

// The tiles of 8 x 8 pixels that are not wholly blank, in no order, behind the arguments of a dispatch that
// gives each a workgroup. Wanted before: TILES_BINDING, and TILES_ACCESS.

struct DarkTile {
    uint place;     // of the n-th in the list: column in the lower half, row in the upper
    uint is_listed; // the n-th tile of the page, row by row
};

layout(scalar, binding = TILES_BINDING) TILES_ACCESS buffer DarkTiles
{
    uvec4 tile_groups;
    DarkTile dark_tiles[];
};

#endif
