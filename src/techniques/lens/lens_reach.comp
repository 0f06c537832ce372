// SPDX-License-Identifier: MIT
// One thread finds how far a tile has to look: the largest near circle that reaches it, its own ones.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D tile_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_reach;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;

#include "techniques/lens/lens_texel.glsl"

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 count = padded_px() / int(lens_tile_px);
    if (any(greaterThanEqual(tile, count))) {
        return;
    }
    int reach = int(ceil(constants.most_px / float(lens_tile_px)));
    int side = 2 * reach + 1;
    float near = 0.0;
    for (int i = 0; i < side * side; ++i) {
        ivec2 aside = ivec2(i % side, i / side) - reach;
        float there = texelFetch(tile_image, clamp(tile + aside, ivec2(0), count - 1), 0).x;
        int tiles_between = max(max(abs(aside.x), abs(aside.y)) - 1, 0);
        near = there >= float(tiles_between * int(lens_tile_px)) ? max(near, there) : near;
    }
    float own = texelFetch(tile_image, tile, 0).y;
    imageStore(out_reach, tile, vec4(near, own, 0.0, 0.0));
}
