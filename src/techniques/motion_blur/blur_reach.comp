// SPDX-License-Identifier: MIT
// One thread handles one tile. The thread finds the longest displacement that reaches the tile, from the tile
// itself or from other tiles. The thread lists the tile if the tile's pixels must be drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tiles.glsl"
#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D tile_image;
layout(binding = 1, rg16f) writeonly uniform image2D out_reach;

#define TILE_LIST_BINDING 2
#include "shaders/tile_list_fill.glsl"

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool shows_velocity = (variant & blur_shows_velocity) != 0u;

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 count = ivec2((constants.size_px + blur_tile_px - 1u) / blur_tile_px);
    if (any(greaterThanEqual(tile, count))) {
        return;
    }
    int reach = tiles_to_each_side(constants.most_px, blur_tile_px);
    int tiles = (2 * reach + 1) * (2 * reach + 1);
    vec2 longest = texelFetch(tile_image, tile, 0).xy;
    int i = 0;
    do {
        TileAbout about = tile_about(tile, reach, i, count);
        vec2 way = texelFetch(tile_image, about.tile, 0).xy;
        // A displacement in another tile reaches this tile if, along each axis, the displacement is at least
        // as long as the gap between the tiles.
        bool gets_here = all(greaterThanEqual(abs(way), vec2(about.between * int(blur_tile_px))));
        longest = gets_here && dot(way, way) > dot(longest, longest) ? way : longest;
    } while (++i < tiles);
    imageStore(out_reach, tile, vec4(longest, 0.0, 0.0));
    uvec2 from_px = blur_tile_px * uvec2(tile);
    bool is_seen = all(lessThan(from_px, constants.window_max_px)) &&
                   all(greaterThan(from_px + blur_tile_px, constants.window_min_px));
    if (!is_seen || (longest == vec2(0.0) && !shows_velocity)) {
        return;
    }
    uint side = blur_tile_px / 8u;
    list_square(side * uvec2(tile), side, constants.size_px);
}
