// SPDX-License-Identifier: MIT
// Empties the list of dark tiles: a thread for each tile there is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/items.glsl"

#define TILES_BINDING 0
#define TILES_ACCESS writeonly
#include "techniques/hatch/dark_tiles.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform Constants
{
    uint tile_count;
};

void main()
{
    uint item = item_index();
    if (item == 0u) {
        tile_groups = uvec4(0u, 1u, 1u, 0u);
    }
    if (item < tile_count) {
        dark_tiles[item].is_listed = 0u;
    }
}
