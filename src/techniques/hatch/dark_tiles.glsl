// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DARK_TILES
#define ESTAMPE_DARK_TILES

// A list of the tiles of 8 x 8 pixels that are not entirely blank, in any order. The list follows the
// arguments of an indirect dispatch with one workgroup per tile. Requires DARK_TILES_BINDING and the
// extensions for subgroups.

struct DarkTile {
    // Entry n holds the position of the n-th listed tile: the tile's column in the lower 16 bits, its row in
    // the upper 16 bits.
    uint place;
    uint is_listed; // in entry n: 1 if the n-th tile of the page, row by row, is already listed
};

layout(scalar, binding = DARK_TILES_BINDING) buffer DarkTiles
{
    uvec4 tile_groups;
    DarkTile dark_tiles[];
};

// Lists the workgroup's tile if a pixel has any darkness. The threads of a tile share results through
// subgroup operations, because barriers are slow on CPU devices.
void list_dark_tile(float dark)
{
    if (subgroupAny(dark > 0.0) && subgroupElect()) {
        uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        if (atomicExchange(dark_tiles[tile].is_listed, 1u) == 0u) {
            dark_tiles[atomicAdd(tile_groups.x, 1u)].place = gl_WorkGroupID.y << 16 | gl_WorkGroupID.x;
        }
    }
}

#endif
