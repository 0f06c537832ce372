// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HORIZON_GLSL_H
#define ESTAMPE_HORIZON_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint horizon_slices = 2U;      // planes through the eye's ray that a pixel looks along
SHARED_CONSTANT uint horizon_steps = 5U;       // of each slice to either side
SHARED_CONSTANT uint horizon_pattern = 4U;     // pixels a side after which directions repeat
SHARED_CONSTANT float horizon_least_px = 2.0F; // a smaller neighbourhood hides nothing

// Occlusion is found at every second pixel of the page each way: pixel `i` of the half page is pixel
// 2 * (from_half + i) of the page.
struct HorizonConstants {
    float radius_m;  // nothing farther off counts
    float reach_px;  // nor what is farther off on the page
    float thickness; // of what is seen from one side, as a share of the radius
    float strength;  // exponent of what is open
    uvec2 from_half;
    uvec2 half_px;
};

#ifdef __cplusplus
static_assert(sizeof(HorizonConstants) == 32);
} // namespace estampe::shared
#endif

#endif
