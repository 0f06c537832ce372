// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_GLSL_H
#define ESTAMPE_LIGHT_GLSL_H
// Data of light and exposure that shaders share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Types of lights. A flag for the falloff lies above the mask of types.
SHARED_CONSTANT uint light_directional = 0U;
SHARED_CONSTANT uint light_point = 1U;
SHARED_CONSTANT uint light_spot = 2U;
SHARED_CONSTANT uint light_pyramid = 3U;
SHARED_CONSTANT uint light_type_mask = 255U;
// Flag: the local light falls off with 1 - (distance / range)^2.
SHARED_CONSTANT uint light_unit_volume = 1U << 8U;

// A light in anchor space (scene coordinates relative to a point near the camera), with the exposure
// multiplied in. `position` is unused for directional lights.
struct LightRecord {
    vec3 position;
    float range_m;  // distance beyond which the light has no effect
    vec3 direction; // direction towards a directional light, or along the beam of a spot
    uint type;
    vec3 color;
    float cone_scale; // for spots: the cone's factor is saturate(cos(angle) * scale + offset) squared
    float cone_offset;
    vec3 side;   // for pyramid-shaped spots: the x axis of the light's node
    uint shadow; // index of the light's first LocalShadow, plus 1; 0: no shadow map
    // Bits 0-15: object groups that the light lights; bits 16-31: groups that cast the light's shadows.
    uint groups;
    float radius_m; // radius of the glowing ball, for penumbrae; negative: the style's radius
    // 1: the light stands for reflected light, so occlusion darkens the light like ambient light.
    uint is_fill;
};

struct LightGlobals {
    vec3 sky_ambient;
    vec3 ground_ambient;
    // Number of directional lights, which come first in the list; the first one casts the sun's shadow.
    uint directional_count;
    uint local_count;
    float falloff; // exponent of the cosine of incidence; 1 is Lambert's law
    // Increase, per metre, of the share of sunlight that lightens the sun's shadow on blank ground.
    vec3 paling;
    float paling_at_anchor;
};

// The page's large tiles, row by row. Each tile has a list of lights.
struct ListTiles {
    uint columns;
    uint tile_px;
};

SHARED_CONSTANT uint exposure_bins = 256U;
SHARED_CONSTANT float exposure_bins_per_stop = 8.0F;
// Brightness at the lower edge of the histogram's first bin.
SHARED_CONSTANT float exposure_darkest_stops = -16.0F;

// The automatic exposure, kept from frame to frame on the device.
struct ExposureState {
    float stops;   // exposure of the page in stops
    uint is_known; // 0 before the first frame; 1 once the exposure is known
    uint bins[exposure_bins];
};

struct AdaptConstants {
    float compensation_stops;
    float most_change_stops; // largest change of the exposure since the last frame; negative: no limit
};

#ifdef __cplusplus
static_assert(sizeof(LightRecord) == 80);
static_assert(sizeof(LightGlobals) == 52);
static_assert(sizeof(ExposureState) == 1032);
} // namespace estampe::shared
#endif

#endif
