// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILE_LIST
#define ESTAMPE_TILE_LIST

// A list of tiles to process; see tiles.glsl.h. Requires TILE_LIST_BINDING.

#include "shaders/tiles.glsl.h"

layout(scalar, binding = TILE_LIST_BINDING) readonly buffer TileList
{
    uint tile_list[];
};

// Whether this group has a tile in the list.
bool has_listed_tile()
{
    return gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x < tile_list[tile_list_count];
}

// First pixel of this group's tile. Groups beyond the end of the list repeat the last tile, which changes
// nothing; skipping them would cost a processor a mask for all groups.
uvec2 listed_from_px()
{
    uint number = gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x;
    uint tile = tile_list[tile_list_first + min(number, tile_list[tile_list_count] - 1u)];
    return 8u * uvec2(tile & 0xffffu, tile >> 16);
}

#endif
