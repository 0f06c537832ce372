// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILE_LIST
#define ESTAMPE_TILE_LIST

// Reads a list of page tiles to process; see tiles.glsl.h. Requires TILE_LIST_BINDING.

#include "shaders/tiles.glsl.h"

layout(scalar, binding = TILE_LIST_BINDING) readonly buffer TileList
{
    uint tile_list[];
};

// Whether the list has a tile for this workgroup.
bool has_listed_tile()
{
    return gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x < tile_list[tile_list_count];
}

// First pixel of this workgroup's tile. Groups beyond the end of the list repeat the last tile, which changes
// nothing. Skipping them would need a mask for all groups on CPUs.
uvec2 listed_from_px()
{
    uint number = gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x;
    uint tile = tile_list[tile_list_first + min(number, tile_list[tile_list_count] - 1u)];
    return 8u * uvec2(tile & 0xffffu, tile >> 16);
}

#endif
