// SPDX-License-Identifier: MIT
// One thread finds the longest displacement of all pixels in one tile, during half the exposure.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tiles.glsl"
#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_tile;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    const int side = int(blur_tile_px);
    ivec2 last = ivec2(constants.size_px) - 1;
    if (any(greaterThan(side * tile, last))) {
        return;
    }
    vec2 longest = vec2(0.0);
    for (int i = 0; i < side * side; ++i) {
        ivec2 pixel = min(pixel_of_tile(tile, side, i), last);
        vec2 way = unpackHalf2x16(texelFetch(page_image, pixel, 0).w);
        longest = dot(way, way) > dot(longest, longest) ? way : longest;
    }
    imageStore(out_tile, tile, vec4(longest, 0.0, 0.0));
}
