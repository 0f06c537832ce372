// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIST_TILES
#define ESTAMPE_LIST_TILES

// Wanted before: ink_tiles.glsl, and `constants` with the page's width.

// Lists the tiles of a rectangle of pixels.
void list_tiles(ivec2 low, ivec2 high)
{
    uint columns = (constants.width + 7u) / 8u;
    if (any(greaterThanEqual(low, high))) {
        return;
    }
    for (int y = low.y / 8; y <= (high.y - 1) / 8; ++y) {
        for (int x = low.x / 8; x <= (high.x - 1) / 8; ++x) {
            uint tile = uint(y) * columns + uint(x);
            if (atomicExchange(ink_tiles[tile].is_listed, 1u) == 0u) {
                ink_tiles[atomicAdd(tile_count, 1u)].tile = tile;
            }
        }
    }
}

#endif
