// SPDX-License-Identifier: MIT
// One thread per pixel adds its brightness to a histogram of the logarithm of light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "techniques/light/light.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D light_image;
layout(binding = 1) uniform usampler2D draw_image;

layout(scalar, binding = 2) buffer State
{
    ExposureState state;
};

shared uint counts[exposure_bins];

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    for (uint i = gl_LocalInvocationIndex; i < exposure_bins; i += 64u) {
        counts[i] = 0u;
    }
    barrier();
    bool on_page = all(lessThan(pixel, textureSize(light_image, 0)));
    uint word = on_page ? texelFetch(draw_image, pixel, 0).x : 0u;
    float light = on_page ? texelFetch(light_image, pixel, 0).w : 0.0;
    if (sees_draw(word) && (word & DRAW_UNLIT) == 0u && light > 0.0) {
        float bin = exposure_bins_per_stop * (log2(light) - exposure_darkest_stops);
        atomicAdd(counts[uint(clamp(bin, 0.0, float(exposure_bins) - 1.0))], 1u);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < exposure_bins; i += 64u) {
        if (counts[i] > 0u) {
            atomicAdd(state.bins[i], counts[i]);
        }
    }
}
