// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) takes a Gaussian mean of depths along a row or a
// column. On a plane, reversed depth is linear over the page, so a plane equals its own mean. Taps (depths
// that are read) count in pairs, so that a plane also equals its own mean at the page's edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/loops.glsl"
#include "techniques/occlusion/alternatives/unsharp.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform sampler2D mean_image; // mean depth along rows, which the column pass reads
layout(binding = 3, r32f) writeonly uniform image2D out_mean;

layout(push_constant, scalar) uniform Constants
{
    UnsharpConstants constants;
};

layout(constant_id = 0) const uint is_upright = 0u;

#include "techniques/occlusion/half_page.glsl"

bool is_on_half_page(ivec2 half_pixel)
{
    return all(greaterThanEqual(half_pixel, ivec2(0))) && all(lessThan(uvec2(half_pixel), constants.half_px));
}

float depth_at(ivec2 half_pixel)
{
    ivec2 held = clamp(half_pixel, ivec2(0), ivec2(constants.half_px) - 1);
    if (is_upright != 0u) {
        return texelFetch(mean_image, held, 0).x;
    }
    return texelFetch(depth_image, whole_pixel(held), 0).x;
}

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    // The blur's direction is computed at run time, because Mesa replaces a vector that a specialization
    // constant selects with the constant's default.
    vec2 along = vec2(1.0 - float(is_upright), float(is_upright));
    float step_px = max(0.5 * constants.reach_px / float(unsharp_taps), 1.0);
    vec2 sum = vec2(depth_at(half_pixel), 1.0);
    for (int i = 1; i <= loop_rounds(int(unsharp_taps), half_pixel.x); ++i) {
        ivec2 offset = ivec2(round(float(i) * step_px * along));
        ivec2 before = half_pixel - offset;
        ivec2 after = half_pixel + offset;
        float deviations = 2.0 * float(i) / float(unsharp_taps);
        float weight =
            is_on_half_page(before) && is_on_half_page(after) ? exp(-0.5 * deviations * deviations) : 0.0;
        sum += weight * vec2(depth_at(before) + depth_at(after), 2.0);
    }
    imageStore(out_mean, half_pixel, vec4(sum.x / sum.y));
}
