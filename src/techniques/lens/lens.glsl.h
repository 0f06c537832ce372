// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_GLSL_H
#define ESTAMPE_LENS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits: each bit compiles one feature into a lens shader.
SHARED_CONSTANT uint lens_has_sky = 1U << 0U;   // the sky's strokes are drawn where no surface is visible
SHARED_CONSTANT uint lens_wash_only = 1U << 1U; // hatching and lines are not blurred
SHARED_CONSTANT uint lens_of_page = 1U << 2U;   // the pass makes the first mip level, from the page's pixels
// Texels of the mip levels are plain means; near and far surfaces are not separated.
SHARED_CONSTANT uint lens_plain = 1U << 3U;
SHARED_CONSTANT uint lens_has_blades = 1U << 4U;
// The page was blurred in the mode `gather`, with a near and a far field.
SHARED_CONSTANT uint lens_is_gathered = 1U << 5U;
SHARED_CONSTANT uint lens_shows_circles = 1U << 6U;
SHARED_CONSTANT uint lens_is_down = 1U << 7U; // second, vertical pass of the separable blur
// Sums all mip levels whose texels are not larger than the blur circle.
SHARED_CONSTANT uint lens_is_sum = 1U << 8U;

// Number of mip levels; the texels of mip levels are 2, 4, ... 32 pixels wide.
SHARED_CONSTANT uint lens_levels = 5U;
SHARED_CONSTANT uint lens_block_px = 32U;   // side of a texel of the coarsest mip level
SHARED_CONSTANT uint lens_tile_px = 16U;    // side of a tile of pixels that share one search radius
SHARED_CONSTANT float lens_sharp_px = 0.5F; // a pixel whose blur circle has a smaller radius counts as sharp
// Largest radius of a blur that reads only pixels, not mip levels.
SHARED_CONSTANT float lens_nearly_px = 0.75F;
// Smallest radius of a blur that reads only mip levels, not pixels.
SHARED_CONSTANT float lens_blurred_px = 1.75F;

// Constants of a lens on a page. Mip levels are aligned to blocks of the whole page, so that all tiles of the
// page compute equal texels.
struct LensConstants {
    uvec2 size_px;          // size of the drawn image
    uvec2 pad_px;           // first drawn pixel, relative to the corner of the pixel's block of the page
    float radius_px;        // radius of the circle of confusion at infinite distance, in pixels
    float radius_per_depth; // decrease of the circle's radius per unit of reversed depth
    float most_px;          // upper limit of the radius of any circle of confusion
    float blade_rad;        // angle of one side of the polygonal aperture, in radians
    float blade_turn_rad;   // rotation of the aperture, in radians
    float blade_scale;      // factor that scales a disc to a polygon of equal area
    float line_reach_px;    // largest distance of a line's pixel from the edge that the line follows
    float widening;         // growth of a line's width per pixel of the blur circle's radius
    // Relative growth of strokes and of the strokes' distance, per pixel of the blur circle's radius.
    float widening_per_px;
    float paling_per_px; // share of ink that is lost per pixel of the circle's radius
    float most_wider_px; // largest growth of a line on each side
    uint level;          // number of the mip level that the pass writes
};

#ifdef __cplusplus
static_assert(sizeof(LensConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
