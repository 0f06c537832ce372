// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_GLSL_H
#define ESTAMPE_LIGHT_GLSL_H
// Data that the shaders of light and exposure share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Types of lights, with a flag above the mask.
SHARED_CONSTANT uint light_directional = 0U;
SHARED_CONSTANT uint light_point = 1U;
SHARED_CONSTANT uint light_spot = 2U;
SHARED_CONSTANT uint light_pyramid = 3U;
SHARED_CONSTANT uint light_type_mask = 255U;
SHARED_CONSTANT uint light_unit_volume = 1U << 8U; // local lights: falls off with 1 - (d / range)^2

// A light in anchor space, with the exposure multiplied in. `position` is unused for directional lights.
struct LightRecord {
    vec3 position;
    float range_m;  // no light reaches beyond this distance
    vec3 direction; // towards a directional light; along the beam of a spot
    uint type;
    vec3 color;
    float cone_scale; // spots: saturate(cos(angle) * scale + offset) squared
    float cone_offset;
    vec3 side;      // pyramids: the x axis of the node
    uint shadow;    // index of the light's first LocalShadow, plus one; 0: none
    uint groups;    // bits 0-15: groups that it lights; bits 16-31: groups whose casters block it
    float radius_m; // radius of the glowing ball, for penumbrae; negative: from the style
    uint is_fill;   // 1: stands for reflected light, so occlusion applies to it as to ambient
};

struct LightGlobals {
    vec3 sky_ambient;
    vec3 ground_ambient;
    uint directional_count; // directional lights come first in the list; the first one casts the sun's shadow
    uint local_count;
    float falloff; // exponent of the cosine; 1 is Lambert's law
    // Gradient, per metre, of the share of sunlight that returns to its shadow on the blank ground.
    vec3 paling;
    float paling_at_anchor;
};

// The page's large tiles, row by row; each has a list of lights.
struct ListTiles {
    uint columns;
    uint tile_px;
};

SHARED_CONSTANT uint exposure_bins = 256U;
SHARED_CONSTANT float exposure_bins_per_stop = 8.0F;
SHARED_CONSTANT float exposure_darkest_stops = -16.0F; // lower edge of the first bin

// The page's brightness, kept from frame to frame.
struct ExposureState {
    float stops;   // exposure of the page
    uint is_known; // 0 before the first frame
    uint bins[exposure_bins];
};

struct AdaptConstants {
    float compensation_stops;
    float most_change_stops; // largest change since the last frame; negative: no limit
};

#ifdef __cplusplus
static_assert(sizeof(LightRecord) == 80);
static_assert(sizeof(LightGlobals) == 52);
static_assert(sizeof(ExposureState) == 1032);
} // namespace estampe::shared
#endif

#endif
