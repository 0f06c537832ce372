// SPDX-License-Identifier: MIT
// One thread per tile of 8 x 8 pixels lists the tile if a visible surface has a second colour for the shade.
// CPUs test several tiles in lockstep, pixel by pixel, until all are decided.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/surface_images.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D draw_image;

#define SHADE_TEXELS_BINDING 1
#include "techniques/surface/shade_texels.glsl"

#define TILE_LIST_BINDING 2
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
    ivec2 last_px = ivec2(size_px) - 1;
    bool is_there = false;
    int i = 0;
    do {
        ivec2 pixel = min(ivec2(from_px) + ivec2(i & 7, i >> 3), last_px);
        uint word = texelFetch(draw_image, pixel, 0).x;
        is_there = is_there || (sees_draw(word) && has_shade(draw_of(word)));
        ++i;
    } while (subgroupAny(!is_there && i < loop_rounds(64, int(tile.x))));
    if (is_on_page && is_there) {
        list_tile(tile);
    }
}
