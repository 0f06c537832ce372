// SPDX-License-Identifier: MIT
// One thread per tile of 8 x 8 pixels: lists the tile if any surface is visible in it. On a CPU device each
// lane scans one tile pixel by pixel, until all lanes have an answer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/shared.glsl"
#include "shaders/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usamplerBuffer visibility_texels;

#define TILE_LIST_BINDING 1
#include "shaders/tile_list_fill.glsl"

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    uvec2 from_px = 8u * tile;
    bool is_on_page = all(lessThan(from_px, size_px));
    from_px = min(from_px, size_px - 1u);
    bool is_seen = false;
    int i = 0;
    do {
        uvec2 pixel = min(from_px + uvec2(i & 7, i >> 3), size_px - 1u);
        is_seen =
            is_seen || sees_triangle(texelFetch(visibility_texels, int(pixel.y * size_px.x + pixel.x)).xy);
        ++i;
    } while (subgroupAny(!is_seen && i < loop_rounds(64, int(tile.x))));
    if (is_on_page && is_seen) {
        list_tile(tile);
    }
}
