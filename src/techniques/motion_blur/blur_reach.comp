// SPDX-License-Identifier: MIT
// One thread finds the longest way that reaches a tile, its own or another's.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D tile_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_reach;

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 count = ivec2((constants.size_px + blur_tile_px - 1u) / blur_tile_px);
    if (any(greaterThanEqual(tile, count))) {
        return;
    }
    int reach = int(ceil(constants.most_px / float(blur_tile_px)));
    int side = 2 * reach + 1;
    vec2 longest = texelFetch(tile_image, tile, 0).xy;
    for (int i = 0; i < side * side; ++i) {
        ivec2 aside = ivec2(i % side, i / side) - reach;
        vec2 way = texelFetch(tile_image, clamp(tile + aside, ivec2(0), count - 1), 0).xy;
        // Along each axis it has to cross what lies between the two tiles.
        vec2 gap_px = vec2(max(abs(aside) - 1, ivec2(0)) * int(blur_tile_px));
        bool gets_here = all(greaterThanEqual(abs(way), gap_px));
        longest = gets_here && dot(way, way) > dot(longest, longest) ? way : longest;
    }
    imageStore(out_reach, tile, vec4(longest, 0.0, 0.0));
}
