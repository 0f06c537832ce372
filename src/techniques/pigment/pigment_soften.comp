// SPDX-License-Identifier: MIT
// One thread per pixel: blurs the ink of strokes and lines horizontally. The colour of lines is multiplied by
// their coverage, so that bare paper has no say in it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/pigment/pigment.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D hatch_image;
layout(binding = 1) uniform sampler2D line_image;
layout(binding = 2, r16f) writeonly uniform image2D out_hatch;
layout(binding = 3, rgba16f) writeonly uniform image2D out_lines;

layout(push_constant, scalar) uniform Constants
{
    PigmentDryConstants constants;
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float hatch = 0.0;
    vec4 lines = vec4(0.0);
    float weights = 0.0;
    int radius = int(constants.radius_px);
    for (int i = -radius; i <= radius; ++i) {
        ivec2 at = ivec2(clamp(pixel.x + i, 0, int(constants.size_px.x) - 1), pixel.y);
        float weight = exp(-constants.falloff * float(i * i));
        vec4 line = texelFetch(line_image, at, 0);
        hatch += weight * texelFetch(hatch_image, at, 0).x;
        lines += weight * vec4(line.rgb * line.a, line.a);
        weights += weight;
    }
    imageStore(out_hatch, pixel, vec4(hatch / weights));
    imageStore(out_lines, pixel, lines / weights);
}
