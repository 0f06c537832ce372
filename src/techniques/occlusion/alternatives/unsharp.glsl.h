// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_UNSHARP_GLSL_H
#define ESTAMPE_UNSHARP_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint unsharp_taps = 8U; // taps (samples) of the Gaussian to either side

// Constants of depth darkening. `from_half` and `half_px` are as in HorizonConstants.
struct UnsharpConstants {
    float reach_px; // two standard deviations of the Gaussian, in pixels of the page
    float radius_m; // in parallel projection: depth behind the mean at which a point turns black
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
