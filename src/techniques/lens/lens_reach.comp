// SPDX-License-Identifier: MIT
// One thread finds two search radii of one tile. The first is the largest blur circle in front of the focus
// that reaches the tile. The second is the largest blur circle in the tile and in neighbouring tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tiles.glsl"
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
    int reach = tiles_to_each_side(constants.most_px, lens_tile_px);
    int tiles = (2 * reach + 1) * (2 * reach + 1);
    float near = 0.0;
    float beside = 0.0;
    int i = 0;
    do {
        TileAbout about = tile_about(tile, reach, i, count);
        vec2 largest = texelFetch(tile_image, about.tile, 0).xy;
        // The largest blur circle is also searched in neighbouring tiles, because a pixel may depend on
        // blurred pixels of neighbouring tiles.
        beside = all(lessThanEqual(about.away, ivec2(1))) ? max(beside, largest.y) : beside;
        int between_px = max(about.between.x, about.between.y) * int(lens_tile_px);
        near = largest.x >= float(between_px) ? max(near, largest.x) : near;
    } while (++i < tiles);
    imageStore(out_reach, tile, vec4(near, beside, 0.0, 0.0));
}
