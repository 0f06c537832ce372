// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HATCH_GLSL_H
#define ESTAMPE_HATCH_GLSL_H
// Data that the shaders of hatching, and of tracing its lines, share with C++.
#include "shaders/tone.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_source = 0xffffffffU; // the strokes of no other pixel run over into this pixel

// Ramp of a tonal art map: for darknesses from 0 to 1, the value to look up so that the mean ink is that
// darkness: a threshold, or a tone counted from 0 for paper. `ramp_steps` rows cover the blend from a level
// to the next coarser one. The first block is the finest level over itself at twice the size; one block per
// level follows.
SHARED_CONSTANT uint ramp_length = 256U;
SHARED_CONSTANT uint ramp_steps = 8U;

// Variant bits of darkness.comp.
SHARED_CONSTANT uint darkness_has_fade = 1U << 0U;     // strokes fade with distance
SHARED_CONSTANT uint darkness_has_screen = 1U << 1U;   // there are transparent surfaces
SHARED_CONSTANT uint darkness_has_variants = 1U << 2U; // draws one of several style variants
SHARED_CONSTANT uint darkness_keeps_ink = 1U << 3U;    // adds to the ink of variants drawn before

// Variant bits of overrun.comp.
SHARED_CONSTANT uint overrun_is_first = 1U << 0U; // first step: each pixel is its own source

// Variant bits of lines.comp and trace.comp.
SHARED_CONSTANT uint lines_has_growth = 1U << 0U;      // newborn strokes grow in length
SHARED_CONSTANT uint lines_has_overrun = 1U << 1U;     // strokes run over silhouettes
SHARED_CONSTANT uint lines_has_all_tiles = 1U << 2U;   // runs a workgroup for every tile, blank or not
SHARED_CONSTANT uint lines_has_local_light = 1U << 3U; // strokes along the light follow the strongest lamp
SHARED_CONSTANT uint lines_has_ink = 1U << 4U;         // adds to the ink of style variants drawn before
SHARED_CONSTANT uint lines_kinds_shift = 8U;           // one bit per kind of stroke, see stroke_kind.glsl.h

// Variant bits of map.comp.
SHARED_CONSTANT uint map_tone_mask = 3U;
SHARED_CONSTANT uint map_in_order = 0U;  // stroke by stroke, by the thresholds
SHARED_CONSTANT uint map_in_blends = 1U; // blend of two tones
SHARED_CONSTANT uint map_in_steps = 2U;  // one tone or the next
SHARED_CONSTANT uint map_has_overrun = 1U << 2U;
SHARED_CONSTANT uint map_has_ink = 1U << 3U; // adds to the ink of style variants drawn before

// Variant bits of dots.comp.
SHARED_CONSTANT uint dots_has_ink = 1U << 0U; // adds to the ink of style variants drawn before

struct DarknessConstants {
    ToneConstants tone;
    float fade; // share of darkness that is left at infinity; 1 means no fade
    float fade_distance_m;
    uint style_variant; // number of the style variant that is drawn
};

struct LineConstants {
    uvec2 size_px;
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    float cell_px; // shortest distance between two ends on one stroke's line; the longest is twice that
    float pressure;
    float growth;
    float black_above; // darkness above which the paper is filled with ink
    uint layers;
    uint seed;
    vec2 flat_axis_0; // axis across the strokes of the first layer, in UV space and on the page
    vec2 flat_axis_1;
    vec2 flat_axis_2;
    vec2 wind; // horizontal direction x, z
    vec2 ground_wind;
    vec3 towards_light;
    float overrun_px; // distance by which strokes run over silhouettes
};

// Largest share of the remaining darkness that a layer draws if another layer follows.
#ifdef __cplusplus
inline constexpr float first_layer_share = 0.46F;
inline constexpr float next_layer_share = 0.50F;
#else
#define FIRST_LAYER_SHARE 0.46
#define NEXT_LAYER_SHARE 0.50
#endif

// Constants of the search for pixels whose strokes run over into another.
struct OverrunConstants {
    uvec2 size_px;
    int step_px;
};

struct MapConstants {
    uvec2 size_px;
    uint map_size_texels;
    uint tone_count;
    uint level_count;
    float texels_per_px; // scale of the map on the page
    float contrast;      // contrast of the tones about their middle; 1 leaves them unchanged
    float black_above;
    float overrun_px;
};

struct DotConstants {
    float pitch_px;
    vec2 axis;  // direction of the dots' lattice on the page
    uint steps; // number of tones to which darkness is rounded; 0 does not round
    float black_above;
};

// Point where the centre line of strokes passes between the centres of two neighbouring pixels.
struct Crossing {
    uint edge;            // 2 * pixel index, + 1 if the other pixel is below, not to the right
    uint draw;            // number of the draw call + 1
    uint line;            // bits 0-7 family, from bit 8 exponent + 128; v = number * 2^exponent
    int number;           // odd, or 0
    uint place_and_width; // low half: position between pixels, 0 to 65535; high half: width in pixels, half
                          // float
};

#ifdef __cplusplus
static_assert(sizeof(Crossing) == 20);
} // namespace estampe::shared
#endif

#endif
