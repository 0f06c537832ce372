// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HATCH_GLSL_H
#define ESTAMPE_HATCH_GLSL_H
#include "shaders/tone.glsl.h"
#ifdef __cplusplus
namespace estampe::shared {
#endif

struct DarknessConstants {
    ToneConstants tone;
    float fade; // darkness left at infinity, 1 for no fade
    float fade_distance_m;
};

struct LineConstants {
    uvec2 size_px;
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    float cell_px; // shortest distance between two ends of one stroke's line; the longest is twice that
    float pressure;
    float growth;
    float black_above; // darkness from which the paper is simply covered
    uint layers;
    uint seed;
    vec2 flat_axis_0; // across the strokes of each layer, over UVs and on the page
    vec2 flat_axis_1;
    vec2 flat_axis_2;
    vec2 wind; // horizontal direction x, z
    vec3 towards_light;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
