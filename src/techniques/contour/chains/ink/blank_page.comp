// SPDX-License-Identifier: MIT
// One thread clears one pixel of the ink layer, and its word in the list of inked pixels. The threads
// together also clear the list of tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

// The ink layer: square root of the ink's linear colour in rgb, coverage in alpha.
layout(binding = 0, rgba8) writeonly uniform image2D out_ink;

layout(scalar, binding = 1) writeonly buffer Inked
{
    uint inked[];
};

#define INK_TILES_BINDING 2
#define INK_TILES_ACCESS writeonly
#include "techniques/contour/chains/ink/ink_tiles.glsl"

layout(push_constant, scalar) uniform Constants
{
    InkConstants constants;
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uint index = pixel.y * 8u * gl_NumWorkGroups.x + pixel.x;
    uvec2 tiles = (uvec2(constants.width, constants.height) + 7u) / 8u;
    if (index < tiles.x * tiles.y) {
        ink_tiles[index] = InkTile(0u, 0u);
    }
    if (index == 0u) {
        tile_count = 0u;
        group_rows = 1u;
        group_layers = 1u;
        unused = 0u;
    }
    if (pixel.x < constants.width && pixel.y < constants.height) {
        imageStore(out_ink, ivec2(pixel), vec4(sqrt(constants.ink_color), 0.0));
        inked[pixel.y * constants.width + pixel.x] = 0u;
    }
}
