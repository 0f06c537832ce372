// SPDX-License-Identifier: MIT
// Copies the heights of simulated sand to the buffer from which height graphs read textures.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D heights;

layout(scalar, binding = 1) buffer Texels
{
    float texels[];
};

layout(push_constant, scalar) uniform Constants
{
    SandConstants sand;
};

void main()
{
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (all(lessThan(texel, uvec2(sand.side)))) {
        texels[sand.first_texel + texel.y * sand.side + texel.x] = texelFetch(heights, ivec2(texel), 0).r;
    }
}
