// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FOLIAGE
#define ESTAMPE_FOLIAGE

// What the page shows, for lines around clumps of leaves. The functions for points of the page lattice (a
// grid of points on the page) are available in a shader that defined FOLIAGE_BINDING before inclusion, and
// `constants` with the members columns and rows. The functions for pixels are available in a shader that
// defined FOLIAGE_PIXELS_BINDING, the first of three bindings.

#include "techniques/contour/chains/chains.glsl.h"

// A point of the lattice. `place` holds the reversed depth (1 at the near plane, 0 at infinity) in the upper
// bits, then 7 bits for the lightness of the tone (127 is white), and the lowest bit says that the point
// shows foliage. Numbers of nearer points are larger. `pixel` is the pixel whose surface is seen at the
// point, which lies elsewhere if the point was added to a clump: y << 16 | x.
struct FoliagePoint {
    uint place;
    uint pixel;
};

#ifdef FOLIAGE_BINDING
layout(binding = FOLIAGE_BINDING) uniform usamplerBuffer foliage_texels;

FoliagePoint foliage_at(ivec2 point)
{
    ivec2 inside = clamp(point, ivec2(0), ivec2(constants.columns, constants.rows) - 1);
    uvec2 words = texelFetch(foliage_texels, inside.y * int(constants.columns) + inside.x).xy;
    return FoliagePoint(words.x, words.y);
}

bool is_foliage(FoliagePoint point)
{
    return (point.place & 1u) != 0u;
}

float depth_of(FoliagePoint point)
{
    return uintBitsToFloat(point.place & foliage_depth_mask);
}

float lightness_of(FoliagePoint point)
{
    return float(point.place >> 1 & 127u) / 127.0;
}
#endif

#ifdef FOLIAGE_PIXELS_BINDING
#define DRAW_TEXELS_BINDING FOLIAGE_PIXELS_BINDING
#include "shaders/draw_texels.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/surface_images.glsl"

layout(binding = FOLIAGE_PIXELS_BINDING + 1) uniform usampler2D draw_image;
layout(binding = FOLIAGE_PIXELS_BINDING + 2) uniform sampler2D depth_image;

// FoliagePoint::place of a pixel, without the lightness.
uint foliage_place(ivec2 pixel)
{
    uint word = texelFetch(draw_image, pixel, 0).x;
    bool is_leaf = sees_draw(word) && (draw_links_at(draw_of(word)).flags & draw_is_foliage) != 0u;
    float depth = sees_draw(word) ? max(texelFetch(depth_image, pixel, 0).x, 0.0) : 0.0;
    return (floatBitsToUint(depth) & foliage_depth_mask) | (is_leaf ? 1u : 0u);
}
#endif

#endif
