// SPDX-License-Identifier: MIT
// One thread handles one pixel. Where a line runs through solid black, the pixel is left white in its place.
// Lines near the border of the black stay black, because they part the black from the paper.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tone.glsl.h"
#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D hatch_image; // coverage, or `solid_ink` where all is black
layout(binding = 1, rgba8) uniform image2D line_image;
layout(binding = 2, r16f) writeonly uniform image2D out_hatch;

layout(push_constant, scalar) uniform Constants
{
    SpareConstants constants;
};

bool is_solid(ivec2 pixel)
{
    ivec2 last = ivec2(constants.size_px) - 1;
    return texelFetch(hatch_image, clamp(pixel, ivec2(0), last), 0).x > 1.0;
}

// Whether the black reaches far around a pixel: it is solid at eight places on a circle.
bool is_deep(ivec2 pixel)
{
    int straight = int(constants.reach_px);
    int slanting = int(ceil(0.7071 * float(straight)));
    bool result = true;
    for (int i = 0; i < 4; ++i) {
        ivec2 way = i == 0   ? ivec2(straight, 0)
                    : i == 1 ? ivec2(0, straight)
                    : i == 2 ? ivec2(slanting, slanting)
                             : ivec2(slanting, -slanting);
        result = result && is_solid(pixel + way) && is_solid(pixel - way);
    }
    return result;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float ink = min(texelFetch(hatch_image, pixel, 0).x, 1.0);
    vec4 line = imageLoad(line_image, pixel);
    if (line.a > 0.0 && is_solid(pixel) && is_deep(pixel)) {
        ink = 1.0 - constants.spared * line.a;
        imageStore(line_image, pixel, vec4(line.rgb, (1.0 - constants.spared) * line.a));
    }
    imageStore(out_hatch, pixel, vec4(ink));
}
