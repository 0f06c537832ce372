// SPDX-License-Identifier: MIT
// One thread puts one texel of a piece into its place in the sun's map.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/clipmap.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) readonly buffer Depths
{
    uint depths[];
};

layout(scalar, binding = 1) buffer SunMap
{
    uint sun_map[];
};

layout(push_constant, scalar) uniform Constants
{
    SunPieceConstants constants;
};

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, constants.size_px))) {
        return;
    }
    // A level is a torus: the power of two takes care of what lies below zero, too.
    uvec2 place = uvec2(ivec2(constants.low_x, constants.low_y) + ivec2(at)) & (constants.map_size - 1u);
    uint first = constants.level * constants.map_size * constants.map_size;
    sun_map[first + place.y * constants.map_size + place.x] = depths[at.y * constants.size_px.x + at.x];
}
