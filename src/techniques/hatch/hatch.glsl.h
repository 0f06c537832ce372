// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HATCH_GLSL_H
#define ESTAMPE_HATCH_GLSL_H
// What the shaders of hatching, and of tracing its lines, share with C++.
#include "shaders/tone.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_source = 0xffffffffU; // of strokes that run over

// The ramp says, for darknesses from 0 to 1, what to ask of a map so that its mean ink is that darkness: a
// threshold, or a tone counted from 0 for paper. A row for each step from a level to the next coarser one;
// first those of the finest level over itself at twice the size, then those of the levels.
SHARED_CONSTANT uint ramp_length = 256U;
SHARED_CONSTANT uint ramp_steps = 8U;

// Variant bits of darkness.comp.
SHARED_CONSTANT uint darkness_has_fade = 1U << 0U;   // with distance
SHARED_CONSTANT uint darkness_has_screen = 1U << 1U; // there are see-through surfaces
SHARED_CONSTANT uint darkness_has_looks = 1U << 2U;  // surfaces differ, and one look is drawn
SHARED_CONSTANT uint darkness_keeps_ink = 1U << 3U;  // of looks drawn before

// Of overrun.comp.
SHARED_CONSTANT uint overrun_is_first = 1U << 0U; // of its steps: pixels are their own sources

// Of lines.comp and trace.comp.
SHARED_CONSTANT uint lines_has_growth = 1U << 0U;      // newborn strokes grow in length
SHARED_CONSTANT uint lines_has_overrun = 1U << 1U;     // strokes run over silhouettes
SHARED_CONSTANT uint lines_has_all_tiles = 1U << 2U;   // a workgroup for every tile, blank or not
SHARED_CONSTANT uint lines_has_local_light = 1U << 3U; // the one that rules leads strokes along the light
SHARED_CONSTANT uint lines_has_ink = 1U << 4U;         // of looks drawn before
SHARED_CONSTANT uint lines_kinds_shift = 8U; // a bit for each kind that is there, see stroke_kind.glsl.h

// Of map.comp.
SHARED_CONSTANT uint map_tone_mask = 3U;
SHARED_CONSTANT uint map_in_order = 0U;  // stroke by stroke, by the thresholds
SHARED_CONSTANT uint map_in_blends = 1U; // between two tones
SHARED_CONSTANT uint map_in_steps = 2U;  // one tone or the next
SHARED_CONSTANT uint map_has_overrun = 1U << 2U;
SHARED_CONSTANT uint map_has_ink = 1U << 3U; // of looks drawn before

// Of dots.comp.
SHARED_CONSTANT uint dots_has_ink = 1U << 0U; // of looks drawn before

struct DarknessConstants {
    ToneConstants tone;
    float fade; // darkness left at infinity, 1 for no fade
    float fade_distance_m;
    uint look; // that is drawn
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
    vec2 ground_wind;
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

struct DotConstants {
    float pitch_px;
    vec2 axis;  // of the lattice on the page
    uint steps; // tones that darkness is rounded to, 0 for all there are
    float black_above;
};

// Where the middle of a line of strokes passes between the centres of two neighbouring pixels.
struct Crossing {
    uint edge;            // 2 * pixel, row by row, + 1 where the other pixel is below it and not beside it
    uint draw;            // draw + 1
    uint line;            // family; exponent + 128 from bit 8: the line is where v = number * 2^exponent
    int number;           // odd, or 0
    uint place_and_width; // from pixel to pixel, 0 to 65535; width in pixels, a half, above
};

#ifdef __cplusplus
static_assert(sizeof(Crossing) == 20);
} // namespace estampe::shared
#endif

#endif
