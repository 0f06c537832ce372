// SPDX-License-Identifier: MIT
// One thread finds how far a tile has to look: the largest near circle that reaches it, and the
// largest of all in it and beside it.
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
    int reach = int(ceil(max(constants.most_px, 1.0) / float(lens_tile_px)));
    int side = 2 * reach + 1;
    float near = 0.0;
    float beside = 0.0;
    for (int i = 0; i < side * side; ++i) {
        ivec2 aside = ivec2(i % side, i / side) - reach;
        vec2 largest = texelFetch(tile_image, clamp(tile + aside, ivec2(0), count - 1), 0).xy;
        float there = largest.x;
        // What is sharp looks for what is blurred beside it, and the other way round.
        beside = max(abs(aside.x), abs(aside.y)) <= 1 ? max(beside, largest.y) : beside;
        int tiles_between = max(max(abs(aside.x), abs(aside.y)) - 1, 0);
        near = there >= float(tiles_between * int(lens_tile_px)) ? max(near, there) : near;
    }
    imageStore(out_reach, tile, vec4(near, beside, 0.0, 0.0));
}
