// SPDX-License-Identifier: MIT
// One thread finds, for one pixel, the nearest pixel whose strokes may extend into it. The search is jump
// flooding with one step per dispatch, the longest step first. Rong and Tan, "Jump Flooding in GPU with
// Applications to Voronoi Diagram and Distance Transform", I3D 2006.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1) uniform usampler2D draw_image;
// Pixel found in the previous step, x and y in 16 bits each; unused in the first step.
layout(binding = 2) uniform usampler2D before_image;
layout(binding = 3, r32ui) writeonly uniform uimage2D out_source;

layout(push_constant, scalar) uniform Constants
{
    OverrunConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_first = (variant & overrun_is_first) != 0u;

uint source_at(ivec2 pixel)
{
    if (is_first) {
        uint word = texelFetch(draw_image, pixel, 0).x;
        bool is_source = !is_paper(word) && texelFetch(darkness_image, pixel, 0).x > 0.0;
        return is_source ? uint(pixel.x) | uint(pixel.y) << 16 : no_source;
    }
    return texelFetch(before_image, pixel, 0).x;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(constants.size_px);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    uint nearest = no_source;
    float least = 1e9;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = pixel + constants.step_px * (ivec2(i % 3, i / 3) - 1);
        uint source = source_at(clamp(at, ivec2(0), size - 1));
        float away = distance(vec2(pixel), vec2(source & 0xffffu, source >> 16));
        bool is_nearer = source != no_source && away < least;
        nearest = is_nearer ? source : nearest;
        least = is_nearer ? away : least;
    }
    imageStore(out_source, pixel, uvec4(nearest));
}
