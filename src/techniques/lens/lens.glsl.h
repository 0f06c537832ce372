// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_GLSL_H
#define ESTAMPE_LENS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of the lens' shaders.
SHARED_CONSTANT uint lens_has_sky = 1U << 0U;   // strokes of the sky stand where nothing is seen
SHARED_CONSTANT uint lens_wash_only = 1U << 1U; // ink stays as it is
SHARED_CONSTANT uint lens_of_page = 1U << 2U;   // the first level is made from pixels, the others from levels
SHARED_CONSTANT uint lens_plain = 1U << 3U;     // levels are means, whatever lies in them
SHARED_CONSTANT uint lens_has_blades = 1U << 4U;
SHARED_CONSTANT uint lens_is_gathered = 1U << 5U; // near and far fields are laid over each other
SHARED_CONSTANT uint lens_shows_circles = 1U << 6U;
SHARED_CONSTANT uint lens_is_down = 1U << 7U; // the second pass of the separable blur
SHARED_CONSTANT uint lens_is_sum = 1U << 8U;  // blurs of all sizes up to the circle's

SHARED_CONSTANT uint lens_levels = 5U;         // pixels of 2, 4, ... 32 a side
SHARED_CONSTANT uint lens_block_px = 32U;      // what the largest level's texels span
SHARED_CONSTANT uint lens_tile_px = 16U;       // of the page, that share how far they look
SHARED_CONSTANT float lens_sharp_px = 0.5F;    // a circle of a smaller radius is a point
SHARED_CONSTANT float lens_nearly_px = 0.75F;  // up to here pixels are gathered, beyond also larger texels
SHARED_CONSTANT float lens_blurred_px = 1.75F; // and from here on those alone

// A lens on a page. Levels lie on blocks of the whole page, so that a tile of it finds the same in them.
struct LensConstants {
    uvec2 size_px;          // of what is drawn
    uvec2 pad_px;           // of the page, from the last block's corner to the first pixel drawn
    float radius_px;        // of the circle of confusion of what is infinitely far
    float radius_per_depth; // how much less it is for each unit of reversed depth
    float most_px;          // no radius is more
    float blade_rad;        // of the aperture, a blade's turn
    float blade_turn_rad;   // how far it is turned
    float blade_scale;      // from a disc to a polygon of the same area
    float line_reach_px;    // how far a line lies at most from what it belongs to
    float widening;         // of lines, by a pixel of the circle's radius
    float widening_per_px;  // of strokes and their distance, as a share of what they are
    float paling_per_px;    // of their ink
    float most_wider_px;    // no line grows more to a side
    uint level;             // that is made
};

#ifdef __cplusplus
static_assert(sizeof(LensConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
