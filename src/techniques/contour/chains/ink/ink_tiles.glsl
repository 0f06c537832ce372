// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_TILES
#define ESTAMPE_INK_TILES

// An unordered list of the tiles of 8 x 8 pixels that lines cover. The list follows the arguments of an
// indirect dispatch with one workgroup per tile. The list must be empty at first. Requires before inclusion:
// INK_TILES_BINDING, INK_TILES_ACCESS.

struct InkTile {
    uint tile;      // in entry n: the number of the n-th listed tile
    uint is_listed; // in entry n: 1 if the n-th tile of the page, row by row, is already listed
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
