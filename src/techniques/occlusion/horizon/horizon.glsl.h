// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HORIZON_GLSL_H
#define ESTAMPE_HORIZON_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint horizon_slices = 2U;      // planes through the view ray, per pixel
SHARED_CONSTANT uint horizon_steps = 5U;       // steps per slice to either side
SHARED_CONSTANT uint horizon_pattern = 4U;     // width and height in pixels of the pattern of directions
SHARED_CONSTANT float horizon_least_px = 2.0F; // no occlusion if the radius on the page is smaller

// Occlusion is computed at every second pixel each way: pixel `i` of the half page is pixel 2 * (from_half +
// i) of the page.
struct HorizonConstants {
    float radius_m;  // farther occluders are ignored
    float reach_px;  // largest radius on the page
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
