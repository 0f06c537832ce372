// SPDX-License-Identifier: MIT
// One thread draws the streaks of drifting sand at one pixel over the pixel's lines. Where both have ink, the
// darker ink remains.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) readonly buffer Ink
{
    uint ink_at[];
};

// Ink layer with the lines: square root of linear colour in rgb, coverage in alpha.
layout(binding = 1, rgba8) uniform image2D line_image;

layout(push_constant, scalar) uniform Constants
{
    DriftInk drift;
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), drift.size_px))) {
        return;
    }
    float ink = float(ink_at[uint(pixel.y) * drift.size_px.x + uint(pixel.x)]) / 255.0;
    vec4 before = imageLoad(line_image, pixel);
    if (ink > before.a) {
        imageStore(line_image, pixel, vec4(sqrt(drift.ink), ink));
    }
}
