// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILE_LIST_FILL
#define ESTAMPE_TILE_LIST_FILL

// A list of tiles that is being made, see tile_list.glsl.h. Wanted before: TILE_LIST_BINDING.

#include "shaders/tile_list.glsl.h"

layout(scalar, binding = TILE_LIST_BINDING) buffer TileList
{
    uint tile_list[];
};

void list_tile(uvec2 tile)
{
    uint number = atomicAdd(tile_list[tile_list_count], 1u);
    tile_list[tile_list_first + number] = tile.x | tile.y << 16;
    atomicMax(tile_list[0], tile_list_groups);
    atomicMax(tile_list[1], number / tile_list_groups + 1u);
}

#endif
