// SPDX-License-Identifier: MIT
// The includer declares `cell_image` first: values of cells, see pigment.glsl.h.
#ifndef ESTAMPE_PIGMENT_CELLS
#define ESTAMPE_PIGMENT_CELLS

// Value at a place of the page, in pixels, interpolated between the middles of the cells around it.
vec4 spread_at(vec2 page_px, uvec2 from_px, uint cell_px)
{
    vec2 place = page_px / float(cell_px) - vec2(from_px / cell_px) - 0.5;
    ivec2 cell = ivec2(floor(place));
    vec2 share = place - vec2(cell);
    ivec2 last = textureSize(cell_image, 0) - 1;
    ivec2 low = clamp(cell, ivec2(0), last);
    ivec2 high = clamp(cell + 1, ivec2(0), last);
    vec4 above =
        mix(texelFetch(cell_image, low, 0), texelFetch(cell_image, ivec2(high.x, low.y), 0), share.x);
    vec4 below =
        mix(texelFetch(cell_image, ivec2(low.x, high.y), 0), texelFetch(cell_image, high, 0), share.x);
    return mix(above, below, share.y);
}

#endif
