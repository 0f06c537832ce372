// SPDX-License-Identifier: MIT
// Reads sixteen texels around a pixel, or at random places.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) writeonly buffer Results
{
    uint results[];
};

layout(binding = 1) uniform usampler2D picture;

const uint anywhere = 1u;

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uint width = b;
    if (pixel.x >= width || pixel.y * width >= threads) {
        return;
    }
    uint i = pixel.y * width + pixel.x;
    uint sum = 0u;
    for (uint k = 0u; k < 16u; ++k) {
        uint elsewhere = scattered(16u * i + k);
        uvec2 texel =
            (variant & anywhere) != 0u ? uvec2(elsewhere, elsewhere >> 16) : pixel + uvec2(k & 3u, k >> 2);
        sum += texelFetch(picture, ivec2(texel & (width - 1u)), 0).x;
    }
    results[i] = sum;
}
