// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILE_LIST
#define ESTAMPE_TILE_LIST

// A list of tiles to work on, see tiles.glsl.h. Wanted before: TILE_LIST_BINDING.

#include "shaders/tiles.glsl.h"

layout(scalar, binding = TILE_LIST_BINDING) readonly buffer TileList
{
    uint tile_list[];
};

// Whether this group has a tile of its own.
bool has_listed_tile()
{
    return gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x < tile_list[tile_list_count];
}

// First pixel of the tile of this group. Groups past the end of the list do the last one again, which changes
// nothing: to leave them out would cost a processor a mask for all others.
uvec2 listed_from_px()
{
    uint number = gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x;
    uint tile = tile_list[tile_list_first + min(number, tile_list[tile_list_count] - 1u)];
    return 8u * uvec2(tile & 0xffffu, tile >> 16);
}

#endif
