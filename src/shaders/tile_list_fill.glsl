// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILE_LIST_FILL
#define ESTAMPE_TILE_LIST_FILL

// Appends tiles to a list of page tiles; see tiles.glsl.h. Requires TILE_LIST_BINDING. Groups can read data
// that other groups store behind the list.

#include "shaders/tiles.glsl.h"

layout(scalar, binding = TILE_LIST_BINDING) coherent buffer TileList
{
    uint tile_list[];
};

// Reserves entries for `tiles` tiles, at least one, and returns the index of the first entry. All threads
// contend for the counter of tiles, so reserve several tiles with one call.
uint list_room(uint tiles)
{
    uint first = atomicAdd(tile_list[tile_list_count], tiles);
    uint row = (first + tiles - 1u) / tile_list_groups;
    if (first == 0u || row != (first - 1u) / tile_list_groups) {
        atomicMax(tile_list[1], row + 1u);
    }
    return first;
}

void put_tile(uint number, uvec2 tile)
{
    tile_list[tile_list_first + number] = tile.x | tile.y << 16;
}

// Appends to the list the tiles of a square of `side` x `side` tiles that are on the page. The first tile
// must be on the page.
void list_square(uvec2 first, uint side, uvec2 page_px)
{
    uvec2 count = min((page_px + 7u) / 8u - first, uvec2(side));
    uint number = list_room(count.x * count.y);
    for (uint i = 0u; i < count.x * count.y; ++i) {
        put_tile(number + i, first + uvec2(i % count.x, i / count.x));
    }
}

void list_tile(uvec2 tile)
{
    put_tile(list_room(1u), tile);
}

#endif
