// SPDX-License-Identifier: MIT
// One thread finds what one point of the page lattice (a grid of points on the page) shows: the nearest
// foliage among the four pixels at the point, or else the surface at the point's own pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

#define DRAW_TEXELS_BINDING 0
#include "shaders/draw_texels.glsl"

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D light_image;

layout(scalar, binding = 4) writeonly buffer Foliage
{
    uvec2 points[];
};

layout(push_constant, scalar) uniform Constants
{
    FoliageConstants constants;
};

const uint depth_mask = 0xffffff00u;

uvec2 seen_at(ivec2 pixel)
{
    uint word = texelFetch(draw_image, pixel, 0).x;
    bool is_leaf = sees_draw(word) && (draw_links_at(draw_of(word)).flags & draw_is_foliage) != 0u;
    float depth = sees_draw(word) ? max(texelFetch(depth_image, pixel, 0).x, 0.0) : 0.0;
    uint light = uint(127.0 * clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0) + 0.5);
    return uvec2((floatBitsToUint(depth) & depth_mask) | light << 1 | (is_leaf ? 1u : 0u),
                 uint(pixel.y) << 16 | uint(pixel.x));
}

void main()
{
    uvec2 point = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(point, uvec2(constants.columns, constants.rows)))) {
        return;
    }
    ivec2 last = textureSize(draw_image, 0) - 1;
    uvec2 best = uvec2(0u);
    for (int i = 0; i < loop_rounds(4, int(constants.columns)); ++i) {
        uvec2 seen = seen_at(min(ivec2(cell_px * point) + ivec2(i & 1, i >> 1), last));
        bool is_better = (seen.x & 1u) > (best.x & 1u) || ((seen.x & best.x & 1u) != 0u && seen.x > best.x);
        best = i == 0 || is_better ? seen : best;
    }
    points[point.y * constants.columns + point.x] = best;
}
