// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_TILES
#define ESTAMPE_INK_TILES

// An unordered list of the tiles of 8 x 8 pixels that lines cover, after the arguments of a dispatch with one
// workgroup per tile. Must be all zeros at first. Requires before inclusion: INK_TILES_BINDING,
// INK_TILES_ACCESS.

struct InkTile {
    uint tile;      // tile number of the n-th entry of the list
    uint is_listed; // whether the n-th tile of the page, row by row, is listed
};

layout(scalar, binding = INK_TILES_BINDING) INK_TILES_ACCESS buffer InkTiles
{
    uint tile_count; // number of listed tiles
    uint group_rows;
    uint group_layers;
    uint unused;
    InkTile ink_tiles[];
};

#endif
