// SPDX-License-Identifier: MIT
// Writes which triangle was drawn and how far it is, in the form of a visibility buffer, unless the triangle
// is turned away or a mask leaves a hole.

#include "techniques/raster/draw.glsl"

layout(location = 0) flat in uint triangle_drawn;
layout(location = 1) flat in uint triangle_flags;

#ifndef RASTER_DEPTH_ONLY
layout(location = 0) out uvec2 word;
#endif

#ifdef RASTER_MASKED
#define MASK_BINDING 2
#include "techniques/raster/mask.glsl"
#else
layout(constant_id = 0) const uint variant = 0u;
#endif

#ifdef RASTER_BEHIND
#define BEHIND_BINDING (MASK_BINDING + 8)
#include "techniques/raster/behind.glsl"
#endif

void main()
{
#ifdef RASTER_BEHIND
    uint index = uint(gl_FragCoord.y) * PICTURE_PX.x + uint(gl_FragCoord.x);
    if (!lies_behind(index, floatBitsToUint(clamp(gl_FragCoord.z, 1e-30, 1.0)), triangle_drawn)) {
        discard;
    }
#endif
    bool counts_either_way =
        (variant & draw_tests_sides) == 0u || (triangle_flags & triangle_two_sided) != 0u;
    bool front = gl_FrontFacing != ((triangle_flags & triangle_mirrored) != 0u);
    if (!counts_either_way && !front) {
        discard;
    }
#ifdef RASTER_MASKED
    if ((variant & draw_has_no_masks) == 0u && !passes_mask(triangle_drawn, ivec2(gl_FragCoord.xy))) {
        discard;
    }
#endif
#ifndef RASTER_DEPTH_ONLY
    word = uvec2(triangle_drawn, floatBitsToUint(clamp(gl_FragCoord.z, 1e-30, 1.0)));
#endif
}
