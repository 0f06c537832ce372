// SPDX-License-Identifier: MIT
// One thread computes the ground's height at one texel of one field of heights.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Terrain
{
    TerrainGlobals terrain;
};

layout(scalar, binding = 1) uniform Words
{
    uint words[height_words_most]; // the program: places, parameters, instructions
};

layout(binding = 2) uniform samplerBuffer texels;
// Height of the ground, in metres above the anchor (a nearby origin).
layout(binding = 3, r32f) writeonly uniform image2D out_height;

layout(push_constant, scalar) uniform Constants
{
    TerrainFieldConstants constants;
};

#include "techniques/terrain/graph/height_program.glsl"

void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, constants.size))) {
        return;
    }
    ivec2 place = ivec2(texel.x, gl_GlobalInvocationID.z * constants.size.y + texel.y);
    if (!is_within(constants.wanted, gl_GlobalInvocationID.z, texel)) {
        imageStore(out_height, place, vec4(-1e30));
        return;
    }
    TerrainField field = constants.fields[gl_GlobalInvocationID.z];
    float height = height_at(field.origin_m + field.texel_m * vec2(texel), field.texel_m).x;
    imageStore(out_height, place, vec4(height - terrain.anchor_y_m));
}
