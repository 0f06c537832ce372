// SPDX-License-Identifier: MIT
// One workgroup finds the longest displacement of all pixels in one tile, during half the exposure. Each
// thread reads one pixel. If several pixels have the longest displacement, the first of these pixels is used.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = blur_tile_px, local_size_y = blur_tile_px) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_tile;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

// Squared length of the longest displacement, as the bits of a float. The bits of positive floats have the
// same order as the floats, so atomicMax works.
shared uint longest_bits;
shared uint first_thread;

void main()
{
    uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) {
        longest_bits = 0u;
        first_thread = ~0u;
    }
    ivec2 pixel = min(ivec2(gl_GlobalInvocationID.xy), ivec2(constants.size_px) - 1);
    vec2 way = unpackHalf2x16(texelFetch(page_image, pixel, 0).w);
    uint bits = floatBitsToUint(dot(way, way));
    barrier();
    atomicMax(longest_bits, bits);
    barrier();
    if (bits == longest_bits) {
        atomicMin(first_thread, thread);
    }
    barrier();
    if (thread == first_thread) {
        imageStore(out_tile, ivec2(gl_WorkGroupID.xy), vec4(way, 0.0, 0.0));
    }
}
