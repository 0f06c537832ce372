// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUBSURFACE_GLSL_H
#define ESTAMPE_SUBSURFACE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint scatter_taps = 8U; // of a blur, to either side
// Tap i is this times (i + i^2 / 4) standard deviations of the colour that spreads farthest off: dense about
// the middle, for those that spread less.
SHARED_CONSTANT float scatter_spacing = 0.125F;
SHARED_CONSTANT uint scatter_levels = 3U;

// What a look says of light that goes in.
struct SubsurfaceLook {
    vec3 absorbed_per_m; // logarithm of what is lost
    float strength;      // of light that comes through; 0: none does
    float scatter_m;     // of the colour that spreads farthest; 0: none spreads
    vec3 unused;
    vec4 weights[scatter_taps + 1U]; // of the middle and of taps to one side, by colour
};

// Burley's profile is close to what is left where it was and three Gaussians, each the blur of the one
// before by a variance.
struct ScatterLevel {
    float blur;  // standard deviation of the blur, as a share of scatter_m
    float share; // of the light
};

// Every second pixel of the page each way, as `from_half` tells: pixel `i` is pixel 2 * (from_half + i) of
// the page.
struct ScatterConstants {
    uvec2 from_half;
    uvec2 half_px;
    float most_px; // that scatter_m may be on the page
    ScatterLevel level;
    float kept; // share of the light that stays where it was
};

// Bits of the variants.
SHARED_CONSTANT uint subsurface_has_looks = 1U; // surfaces differ
SHARED_CONSTANT uint subsurface_is_upright = 2U;
SHARED_CONSTANT uint subsurface_is_first = 4U; // level

#ifdef __cplusplus
static_assert(sizeof(SubsurfaceLook) == 176);
} // namespace estampe::shared
#endif

#endif
