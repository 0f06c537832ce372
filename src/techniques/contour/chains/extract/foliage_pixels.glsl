// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FOLIAGE_PIXELS
#define ESTAMPE_FOLIAGE_PIXELS

// What the pixels of the page show, as FoliagePoint::place of foliage.glsl without the light. Requires before
// inclusion: chains.glsl.h; FOLIAGE_PIXELS_BINDING, the first of three bindings.

#define DRAW_TEXELS_BINDING FOLIAGE_PIXELS_BINDING
#include "shaders/draw_texels.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/surface_images.glsl"

layout(binding = FOLIAGE_PIXELS_BINDING + 1) uniform usampler2D draw_image;
layout(binding = FOLIAGE_PIXELS_BINDING + 2) uniform sampler2D depth_image;

uint foliage_place(ivec2 pixel)
{
    uint word = texelFetch(draw_image, pixel, 0).x;
    bool is_leaf = sees_draw(word) && (draw_links_at(draw_of(word)).flags & draw_is_foliage) != 0u;
    float depth = sees_draw(word) ? max(texelFetch(depth_image, pixel, 0).x, 0.0) : 0.0;
    return (floatBitsToUint(depth) & foliage_depth_mask) | (is_leaf ? 1u : 0u);
}

#endif
