// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_GLSL_H
#define ESTAMPE_LIGHT_GLSL_H
// What the shaders of light and exposure share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Types of lights, and above their mask a flag.
SHARED_CONSTANT uint light_directional = 0U;
SHARED_CONSTANT uint light_point = 1U;
SHARED_CONSTANT uint light_spot = 2U;
SHARED_CONSTANT uint light_pyramid = 3U;
SHARED_CONSTANT uint light_type_mask = 255U;
SHARED_CONSTANT uint light_unit_volume = 1U << 8U; // of local lights: weakens by 1 - (d / range)^2

// A light in anchor space, exposure multiplied in. Directional: `direction` points to it, `position` is
// unused.
struct LightRecord {
    vec3 position;
    float range_m;  // no light beyond it
    vec3 direction; // towards a directional light; along a spot's beam
    uint type;
    vec3 color;
    float cone_scale; // spots: saturate(cos(angle) * scale + offset) squared
    float cone_offset;
    vec3 side;      // pyramids: the x axis of the node
    uint shadow;    // one more than the first of its views among the shadow maps; 0: none
    uint groups;    // lights those of bits 0-15, is blocked by those of bits 16-31
    float radius_m; // of the ball that glows, for its penumbrae; below 0: as the style says
    uint is_fill;   // stands for light that is thrown about, so occlusion takes of it as of ambient
};

struct LightGlobals {
    vec3 sky_ambient;
    vec3 ground_ambient;
    uint directional_count; // these come first in the list; the first casts the shadow
    uint local_count;
    float falloff; // exponent of the cosine; 1 is Lambert's
    vec3 paling; // of the sun's shadow on the blank ground: the share of light that comes back grows by this
                 // a metre
    float paling_at_anchor;
};

// The large tiles of the page that have a list of lights each, row by row.
struct ListTiles {
    uint columns;
    uint tile_px;
};

SHARED_CONSTANT uint exposure_bins = 256U;
SHARED_CONSTANT float exposure_bins_per_stop = 8.0F;
SHARED_CONSTANT float exposure_darkest_stops = -16.0F; // where the first bin begins

// What is remembered of a page's brightness from frame to frame.
struct ExposureState {
    float stops;   // that the page is brightened by
    uint is_known; // 0 before the first frame
    uint bins[exposure_bins];
};

struct AdaptConstants {
    float compensation_stops;
    float most_change_stops; // from the frame before; negative: any
};

#ifdef __cplusplus
static_assert(sizeof(LightRecord) == 80);
static_assert(sizeof(LightGlobals) == 52);
static_assert(sizeof(ExposureState) == 1032);
} // namespace estampe::shared
#endif

#endif
