// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_GLSL_H
#define ESTAMPE_LENS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of the lens shaders.
SHARED_CONSTANT uint lens_has_sky = 1U << 0U;   // the sky's strokes are drawn where no surface is visible
SHARED_CONSTANT uint lens_wash_only = 1U << 1U; // hatching and lines are not blurred
SHARED_CONSTANT uint lens_of_page = 1U << 2U;   // makes the first level, from pixels
SHARED_CONSTANT uint lens_plain = 1U << 3U;     // texels are means of near and far alike
SHARED_CONSTANT uint lens_has_blades = 1U << 4U;
SHARED_CONSTANT uint lens_is_gathered = 1U << 5U; // blurred by near and far fields
SHARED_CONSTANT uint lens_shows_circles = 1U << 6U;
SHARED_CONSTANT uint lens_is_down = 1U << 7U; // vertical pass of the separable blur
SHARED_CONSTANT uint lens_is_sum = 1U << 8U;  // sums the levels of all sizes up to the circle's

SHARED_CONSTANT uint lens_levels = 5U;         // levels have texels of 2, 4, ... 32 pixels a side
SHARED_CONSTANT uint lens_block_px = 32U;      // side of a texel of the largest level
SHARED_CONSTANT uint lens_tile_px = 16U;       // side of a tile of pixels that share one search radius
SHARED_CONSTANT float lens_sharp_px = 0.5F;    // a blur circle of a smaller radius counts as sharp
SHARED_CONSTANT float lens_nearly_px = 0.75F;  // largest radius that is gathered from pixels alone
SHARED_CONSTANT float lens_blurred_px = 1.75F; // smallest radius that is gathered from levels alone

// A lens on a page. Levels are aligned to blocks of the whole page, so that each tile of it computes the same
// texels.
struct LensConstants {
    uvec2 size_px;          // size of what is drawn
    uvec2 pad_px;           // from the corner of a block to the first drawn pixel
    float radius_px;        // radius of the circle of confusion at infinite distance
    float radius_per_depth; // decrease of the radius per unit of reversed depth
    float most_px;          // upper limit of any radius
    float blade_rad;        // angle that one aperture blade spans
    float blade_turn_rad;   // rotation of the aperture
    float blade_scale;      // scales a disc to a polygon of the same area
    float line_reach_px;    // largest distance of a line's pixel from the edge that it follows
    float widening;         // growth of lines per pixel of the circle's radius
    float widening_per_px;  // relative growth of strokes and their distance, per pixel of the circle's radius
    float paling_per_px;    // loss of ink per pixel of the circle's radius
    float most_wider_px;    // largest growth of a line on each side
    uint level;             // the level that is written
};

#ifdef __cplusplus
static_assert(sizeof(LensConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
