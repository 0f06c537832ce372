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
    float overrun_px; // how far strokes run over silhouettes
};

// The most that a layer draws of the darkness that is left to do, where another follows.
#ifdef __cplusplus
inline constexpr float first_layer_share = 0.46F;
inline constexpr float next_layer_share = 0.50F;
#else
#define FIRST_LAYER_SHARE 0.46
#define NEXT_LAYER_SHARE 0.50
#endif

// Which pixel's strokes run over into another.
struct OverrunConstants {
    uvec2 size_px;
    int step_px;
};

#ifndef __cplusplus
#define NO_SOURCE 0xffffffffu
#endif

struct MapConstants {
    uvec2 size_px;
    uint map_size_texels;
    uint tone_count;
    uint level_count;
    float texels_per_px; // wanted on the page
    float contrast;      // of the tones about their middle; 1 for none
    float black_above;
    float overrun_px;
};

// The ramp says, for darknesses from 0 to 1, what to ask of a map so that its mean ink is that darkness: a
// threshold, or a tone counted from 0 for paper. A row for each step from a level to the next coarser one;
// first those of the finest level over itself at twice the size, then those of the levels.
#ifdef __cplusplus
inline constexpr uint ramp_length = 256;
inline constexpr uint ramp_steps = 8;
#else
#define RAMP_LENGTH 256u
#define RAMP_STEPS 8u
#endif

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
