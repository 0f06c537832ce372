// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PIGMENT
#define ESTAMPE_PIGMENT

#include "techniques/pigment/pigment.glsl.h"

// Optical density of paint that lets the share `through` of the light through (Beer-Lambert law): twice as
// much paint has twice the density.
vec3 density_of(vec3 through)
{
    return -log(clamp(through, vec3(exp(-pigment_densest)), vec3(1.0)));
}

// Value of cells at a place of the page, in pixels, interpolated between the middles of the cells around it.
// `from_px` is the place on the page of the tile that the cells cover.
vec4 spread_at(sampler2D cells, vec2 page_px, uvec2 from_px, uint cell_px)
{
    vec2 place = page_px / float(cell_px) - vec2(from_px / cell_px) - 0.5;
    ivec2 cell = ivec2(floor(place));
    vec2 share = place - vec2(cell);
    ivec2 last = textureSize(cells, 0) - 1;
    ivec2 low = clamp(cell, ivec2(0), last);
    ivec2 high = clamp(cell + 1, ivec2(0), last);
    vec4 above = mix(texelFetch(cells, low, 0), texelFetch(cells, ivec2(high.x, low.y), 0), share.x);
    vec4 below = mix(texelFetch(cells, ivec2(low.x, high.y), 0), texelFetch(cells, high, 0), share.x);
    return mix(above, below, share.y);
}

#endif
