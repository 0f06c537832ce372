// SPDX-License-Identifier: MIT
// One thread per pixel draws the focus lines of the pixel's own sector around the middle, and of the two
// neighbouring sectors.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/focus/focus.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) readonly buffer Lines
{
    FocusLine lines[];
};

// Square root of linear colour in rgb; coverage in alpha.
layout(binding = 1, rgba8) uniform image2D ink_image;

layout(push_constant, scalar) uniform Constants
{
    FocusConstants constants;
};

const float turn = 6.2831853;

float line_coverage(FocusLine line, vec2 from_middle)
{
    float along = dot(from_middle, line.outwards);
    float aside = abs(line.outwards.x * from_middle.y - line.outwards.y * from_middle.x);
    float half_width = line.half_width_px * (along - line.tip_px) / (line.end_px - line.tip_px);
    // A focus line thinner than a pixel keeps a pixel's width and gets paler.
    return along <= line.tip_px
               ? 0.0
               : clamp(max(half_width, 0.5) + 0.5 - aside, 0.0, 1.0) * min(half_width / 0.5, 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    vec2 from_middle = vec2(pixel) + 0.5 - constants.middle_px;
    float angle = atan(from_middle.y, from_middle.x) / turn;
    int count = int(constants.line_count);
    int own = int(floor((angle < 0.0 ? angle + 1.0 : angle) * float(count)));
    float coverage = 0.0;
    for (int i = -1; i <= 1; ++i) {
        coverage = max(coverage, line_coverage(lines[(own + i + count) % count], from_middle));
    }
    vec4 before = imageLoad(ink_image, pixel);
    if (coverage > before.a) {
        imageStore(ink_image, pixel, vec4(sqrt(constants.ink), coverage));
    }
}
