// SPDX-License-Identifier: MIT
// One thread a pixel of the half page takes a Gaussian mean of distances along a row or a column. Taps count
// in pairs, so that a slanted plane that ends at the edge of the page keeps its own distance there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/rounds.glsl"
#include "techniques/occlusion/unsharp.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform sampler2D mean_image; // of rows, where columns are in hand
layout(binding = 3, r32f) writeonly uniform image2D out_mean; // metres; 0 where nothing is seen

layout(push_constant, scalar) uniform Constants
{
    UnsharpConstants constants;
};

layout(constant_id = 0) const uint is_upright = 0u;

#include "techniques/occlusion/half_page.glsl"

float distance_m(ivec2 half_pixel)
{
    bool is_there = all(greaterThanEqual(half_pixel, ivec2(0))) && all(lessThan(uvec2(half_pixel), constants.half_px));
    ivec2 held = clamp(half_pixel, ivec2(0), ivec2(constants.half_px) - 1);
    float away = 0.0;
    if (is_upright != 0u) {
        away = texelFetch(mean_image, held, 0).x;
    } else {
        ivec2 pixel = whole_pixel(held);
        float depth = texelFetch(depth_image, pixel, 0).x;
        away = depth > 0.0 ? ahead_m(anchor_at(frame, vec2(pixel) + 0.5, depth)) : 0.0;
    }
    return is_there ? away : 0.0;
}

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    float own = distance_m(half_pixel);
    // Mesa takes a vector that a specialization constant chooses for the one it has by default.
    vec2 along = vec2(1.0 - float(is_upright), float(is_upright));
    float step_px = max(0.5 * constants.reach_px / float(unsharp_taps), 1.0);
    vec2 sum = vec2(own, 1.0);
    for (int i = 1; i <= rounds(int(unsharp_taps), half_pixel.x); ++i) {
        ivec2 offset = ivec2(round(float(i) * step_px * along));
        float before = distance_m(half_pixel - offset);
        float after = distance_m(half_pixel + offset);
        float deviations = 2.0 * float(i) / float(unsharp_taps);
        float weight = before != 0.0 && after != 0.0 ? exp(-0.5 * deviations * deviations) : 0.0;
        sum += weight * vec2(before + after, 2.0);
    }
    imageStore(out_mean, half_pixel, vec4(own != 0.0 ? sum.x / sum.y : 0.0));
}
