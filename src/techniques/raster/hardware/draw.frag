// SPDX-License-Identifier: MIT
// Writes triangle and depth in the format of a visibility buffer. Discards culled back faces and holes of
// masks.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/hardware/draw.glsl"

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
    bool front = gl_FrontFacing != ((triangle_flags & triangle_mirrored) != 0u);
#ifdef RASTER_BEHIND
    uvec2 second = uvec2(constants.second >> 1, constants.second >> 2) & 1u;
    uvec2 pixel = uvec2(gl_FragCoord.xy) * (1u + (constants.second & draws_second)) + second;
    uint index = pixel.y * constants.peeled_width_px + pixel.x;
    float depth = clamp(gl_FragCoord.z, 1e-30, 1.0);
    float change = fwidth(gl_FragCoord.z);
    bool is_behind = constants.second != 0u ? lies_clearly_behind(index, depth, change, triangle_drawn, front)
                                            : lies_behind(index, floatBitsToUint(depth), triangle_drawn);
    if (!is_behind) {
        discard;
    }
#endif
    bool counts_either_way =
        (variant & draw_tests_sides) == 0u || (triangle_flags & triangle_two_sided) != 0u;
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
