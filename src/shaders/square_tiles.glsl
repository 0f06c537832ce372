// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SQUARE_TILES
#define ESTAMPE_SQUARE_TILES

// Reads a list of tiles of square images (see tiles.glsl.h). Each tile is processed by a group of 256
// threads. Each thread processes four texels of a row per round. Requires SQUARE_TILES_BINDING.

#include "shaders/tiles.glsl.h"

const uint square_tile_rounds = square_tile_texels * square_tile_texels / (4u * 256u);

layout(scalar, binding = SQUARE_TILES_BINDING) readonly buffer SquareTiles
{
    uint square_tiles[];
};

// Index of the square image that contains this group's tile.
uint square_of_group()
{
    return square_tiles[gl_WorkGroupID.x] >> 16;
}

// Image coordinates, in this round, of the first of this thread's four texels.
uvec2 texel_of_round(uint i)
{
    uint tile = square_tiles[gl_WorkGroupID.x];
    uint first = 4u * (256u * i + gl_LocalInvocationID.x);
    return square_tile_texels * uvec2(tile & 0xffu, (tile >> 8) & 0xffu) +
           uvec2(first % square_tile_texels, first / square_tile_texels);
}

#endif
