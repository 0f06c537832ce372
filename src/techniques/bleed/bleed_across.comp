// SPDX-License-Identifier: MIT
// One thread per pixel: combines the ink of strokes and lines, and blurs it horizontally.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/bleed/bleed.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D hatch_image;
layout(binding = 1) uniform sampler2D line_image;
layout(binding = 2, r16f) writeonly uniform image2D out_smeared;

layout(push_constant, scalar) uniform Constants
{
    BleedConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool only_lines = (variant & bleed_only_lines) != 0u;

float ink_at(int x, int y)
{
    ivec2 pixel = ivec2(clamp(x, 0, int(constants.size_px.x) - 1), y);
    float strokes = only_lines ? 0.0 : texelFetch(hatch_image, pixel, 0).x;
    return 1.0 - (1.0 - strokes) * (1.0 - texelFetch(line_image, pixel, 0).a);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float sum = ink_at(pixel.x, pixel.y);
    float weights = 1.0;
    // The blur adds symmetric pairs of texels, so that a mirrored page gives a bit-identical mirrored
    // picture.
    for (int i = 1; i <= int(constants.radius_px); ++i) {
        float weight = exp(-constants.falloff * float(i * i));
        sum += weight * (ink_at(pixel.x - i, pixel.y) + ink_at(pixel.x + i, pixel.y));
        weights += 2.0 * weight;
    }
    imageStore(out_smeared, pixel, vec4(sum / weights));
}
