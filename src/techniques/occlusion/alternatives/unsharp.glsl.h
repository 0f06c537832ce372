// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_UNSHARP_GLSL_H
#define ESTAMPE_UNSHARP_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint unsharp_taps = 8U; // of the Gaussian, to either side

// The half page as HorizonConstants has it.
struct UnsharpConstants {
    float reach_px; // of the Gaussian, on the page: two standard deviations
    float radius_m; // that far behind what is about it a place is black
    float strength;
    uint unused;
    uvec2 from_half;
    uvec2 half_px;
};

#ifdef __cplusplus
static_assert(sizeof(UnsharpConstants) == 32);
} // namespace estampe::shared
#endif

#endif
