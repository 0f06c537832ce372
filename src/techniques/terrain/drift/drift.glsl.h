// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DRIFT_GLSL_H
#define ESTAMPE_DRIFT_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint drift_streaks_a_cell = 6U;
SHARED_CONSTANT float drift_life_s = 2.4F; // of a streak

// Cells are the texels of a field of heights, numbered on the ground, so that a streak is the same wherever
// the field is.
struct DriftConstants {
    vec2 corner_m; // of the field's first texel's middle, from the anchor
    float cell_m;
    uint side;    // cells
    uint first_x; // number of the first cell on the ground, which wraps
    uint first_y;
    vec2 wind;        // unit, x and z
    float speed_m_s;  // of sand in the air
    uint life;        // number of the life that streaks are in
    float life_share; // of it that has passed for a streak born at its beginning
    float length_m;
    float lift_m;
    float reach_m;
    float half_width_px;
    float amount; // streaks that are there, as a share
};

struct DriftInk {
    vec3 ink; // linear
    uvec2 size_px;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
