// SPDX-License-Identifier: MIT
// One thread finds two radii of one tile: the largest blur circle in front of the plane in focus, and the
// largest blur circle of all surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tiles.glsl"
#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D level_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_tile;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;

#include "techniques/lens/lens_texel.glsl"

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, padded_px() / int(lens_tile_px)))) {
        return;
    }
    const int side = int(lens_tile_px) / 2;
    vec2 largest = vec2(0.0);
    for (int i = 0; i < side * side; ++i) {
        uint rest = texelFetch(level_image, pixel_of_tile(tile, side, i), 0).w;
        vec2 radius_and_part = unpackHalf2x16(rest);
        float radius = radius_and_part.y > 0.0 ? radius_and_part.x : 0.0;
        largest = max(largest, vec2(-radius, abs(radius)));
    }
    imageStore(out_tile, tile, vec4(largest, 0.0, 0.0));
}
