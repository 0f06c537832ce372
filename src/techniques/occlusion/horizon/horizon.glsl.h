// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HORIZON_GLSL_H
#define ESTAMPE_HORIZON_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint horizon_slices = 2U;      // number of slices (planes through the view ray) per pixel
SHARED_CONSTANT uint horizon_steps = 5U;       // number of samples per slice to either side
SHARED_CONSTANT uint horizon_pattern = 4U;     // side in pixels of the repeated pattern of directions
SHARED_CONSTANT float horizon_least_px = 2.0F; // smallest radius on the page, in pixels, that gives occlusion

// Constants of the horizon method, which computes occlusion on the half page (every second pixel in x and y).
// The half-page pixel at the index `i` is the page's pixel 2 * (from_half + i).
struct HorizonConstants {
    float radius_m;  // largest distance of a surface that occludes, in metres
    float reach_px;  // largest occlusion radius in pixels of the page
    float thickness; // assumed thickness of occluders, as a share of the radius
    float strength;  // exponent of the visibility
    uvec2 from_half;
    uvec2 half_px;
};

#ifdef __cplusplus
static_assert(sizeof(HorizonConstants) == 32);
} // namespace estampe::shared
#endif

#endif
