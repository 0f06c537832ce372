// SPDX-License-Identifier: MIT
// One thread mixes four times four texels of one square of a level: what moves, drawn in a picture of its
// own, over what stands still. Of two depths the one nearer to the sun stays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/items.glsl"
#include "techniques/shadow/clipmap.glsl.h"
#include "techniques/shadow/sun.glsl.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Picture
{
    uvec4 picture[];
};

layout(std430, binding = 1) readonly buffer Still
{
    uvec4 still[];
};

layout(std430, binding = 2) writeonly buffer Map
{
    uvec4 map[];
};

layout(push_constant, scalar) uniform Constants
{
    MixedSquare squares[sun_levels];
};

void main()
{
    MixedSquare square = squares[gl_WorkGroupID.y];
    uint side_log2 = square.sizes & 255u;
    uint level_log2 = (square.sizes >> 8) & 255u;
    for (uint i = 0u; i < 4u; ++i) {
        uint item = 256u * gl_WorkGroupID.x + 64u * i + gl_LocalInvocationID.x;
        if (4u * item < 1u << (2u * side_log2)) {
            uint row = item >> (side_log2 - 2u);
            uint column = 4u * item & ((1u << side_log2) - 1u);
            // A level holds its texels modulo its size.
            uvec2 at = (square.low + uvec2(column, row)) & ((1u << level_log2) - 1u);
            uint texel = (((square.sizes >> 16) << level_log2 | at.y) << level_log2) | at.x;
            map[texel / 4u] = max(picture[square.first_texel / 4u + item], still[texel / 4u]);
        }
    }
}
