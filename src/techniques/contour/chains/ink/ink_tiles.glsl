// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_TILES
#define ESTAMPE_INK_TILES

// The tiles of 8 x 8 pixels that lines run through, in no order, behind the arguments of a dispatch that
// gives each a workgroup. All zeros to begin with. Wanted before: INK_TILES_BINDING, INK_TILES_ACCESS.

struct InkTile {
    uint tile;      // of the n-th in the list
    uint is_listed; // the n-th tile of the page, row by row
};

layout(scalar, binding = INK_TILES_BINDING) INK_TILES_ACCESS buffer InkTiles
{
    uint tile_count; // tiles listed
    uint group_rows;
    uint group_layers;
    uint unused;
    InkTile ink_tiles[];
};

#endif
