// SPDX-License-Identifier: MIT
// Packs a texel's height and horizon (or share of the sun) into one word, as two halves, for later frames.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/ground/ground_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D height_image;
layout(binding = 1) uniform sampler2D horizon_image;

layout(scalar, binding = 2) writeonly buffer Kept
{
    uint kept[];
};

layout(push_constant, scalar) uniform Constants
{
    GroundKeepConstants constants;
};

void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    uint field = gl_GlobalInvocationID.z;
    if (any(greaterThanEqual(texel, uvec2(constants.size))) || !is_within(constants.wanted, field, texel)) {
        return;
    }
    ivec2 place = ivec2(texel.x, field * constants.size + texel.y);
    float height = texelFetch(height_image, place, 0).r;
    float horizon = texelFetch(horizon_image, place, 0).r;
    uint row = constants.level[field] * constants.size + texel.y;
    kept[row * constants.size + texel.x] = packHalf2x16(vec2(height, horizon));
}
