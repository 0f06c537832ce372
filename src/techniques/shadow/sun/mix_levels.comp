// SPDX-License-Identifier: MIT
// One workgroup merges one tile of a clipmap level: the depths of moving objects, drawn into a separate
// picture, with the depths of static objects. Keeps the depth nearer to the sun.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#define SQUARE_TILES_BINDING 2
#include "shaders/square_tiles.glsl"
#include "techniques/shadow/shadow.glsl.h"

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture
{
    uvec4 picture[];
};

layout(std430, binding = 1) readonly buffer Still
{
    uvec4 still[];
};

layout(std430, binding = 3) writeonly buffer Map
{
    uvec4 map[];
};

layout(push_constant, scalar) uniform Constants
{
    MixedSquare squares[sun_levels];
};

void main()
{
    MixedSquare square = squares[square_of_group()];
    uint side_log2 = square.sizes & 255u;
    uint level_log2 = (square.sizes >> 8) & 255u;
    for (uint i = 0u; i < square_tile_rounds; ++i) {
        uvec2 place = texel_of_round(i);
        uint drawn = square.first_texel + (place.y << side_log2 | place.x);
        // A clipmap level stores texels modulo its size.
        uvec2 at = (square.low + place) & ((1u << level_log2) - 1u);
        uint texel = (((square.sizes >> 16) << level_log2 | at.y) << level_log2) | at.x;
        map[texel / 4u] = max(picture[drawn / 4u], still[texel / 4u]);
    }
}
