// SPDX-License-Identifier: MIT
// One thread per pixel: blurs the ink vertically, and turns it into solid ink above a threshold.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/bleed/bleed.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D hatch_image;
layout(binding = 1) uniform sampler2D line_image;
layout(binding = 2) uniform sampler2D smeared_image; // ink of strokes and lines, blurred horizontally
layout(binding = 3, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    BleedConstants constants;
};

float smeared_at(int x, int y)
{
    return texelFetch(smeared_image, ivec2(x, clamp(y, 0, int(constants.size_px.y) - 1)), 0).x;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float sum = smeared_at(pixel.x, pixel.y);
    float weights = 1.0;
    for (int i = 1; i <= int(constants.radius_px); ++i) {
        float weight = exp(-constants.falloff * float(i * i));
        sum += weight * (smeared_at(pixel.x, pixel.y - i) + smeared_at(pixel.x, pixel.y + i));
        weights += 2.0 * weight;
    }
    float ran = clamp((sum / weights - constants.level) * constants.contrast + 0.5, 0.0, 1.0);
    ran *= constants.reach;
    float hatch = texelFetch(hatch_image, pixel, 0).x;
    // Contour lines are composited over the result later. Under a line, only so much ink is added that line
    // and result together are as dark as the bled ink. Where no ink bled, the soft edges of lines do not
    // change.
    float bare = 1.0 - texelFetch(line_image, pixel, 0).a;
    float under = bare > 0.0 ? 1.0 - (1.0 - ran) / bare : 0.0;
    imageStore(out_ink, pixel, vec4(max(hatch, under)));
}
