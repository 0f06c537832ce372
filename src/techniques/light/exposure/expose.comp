// SPDX-License-Identifier: MIT
// One thread per pixel multiplies the light by the exposure.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "techniques/light/light.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D light_image;
layout(binding = 1) uniform usampler2D draw_image;

layout(scalar, binding = 2) readonly buffer State
{
    ExposureState state;
};

layout(binding = 3, rgba16f) writeonly uniform image2D out_light;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_light)))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    bool is_lit = sees_draw(word) && (word & DRAW_UNLIT) == 0u;
    vec4 light = texelFetch(light_image, pixel, 0);
    imageStore(out_light, pixel, min(is_lit ? light * exp2(state.stops) : light, vec4(65504.0)));
}
