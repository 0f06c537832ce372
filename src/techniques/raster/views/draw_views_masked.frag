// SPDX-License-Identifier: MIT
// Discards pixels in the holes of alpha masks when many views are drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/views/draw_views.glsl"

layout(location = 0) flat in uint triangle_drawn;
layout(location = 1) flat in uint view_drawn;

RasterView view;
#define CLIP_FROM_ANCHOR view.clip_from_anchor
#define PICTURE_PX uvec2(view.size_px)
#define MASK_BINDING 4
#include "techniques/raster/mask.glsl"

void main()
{
    view = views[view_drawn];
    if (!passes_mask(triangle_drawn, ivec2(gl_FragCoord.xy) - ivec2(view.origin_px))) {
        discard;
    }
}
