// SPDX-License-Identifier: MIT
// Draws a page with a compute shader.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "lab_pixels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D from;
layout(binding = 1, r32ui) uniform writeonly uimage2D to;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(to)))) {
        return;
    }
    imageStore(to, pixel, uvec4(made_of(texelFetch(from, pixel, 0).x), 0u, 0u, 0u));
}
