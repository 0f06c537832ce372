// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HATCH_GLSL_H
#define ESTAMPE_HATCH_GLSL_H
// Data that C++ shares with the shaders of hatching and of tracing (converting hatching lines to paths).
#include "shaders/tone.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Value for a pixel into which the strokes of no other pixel run over.
SHARED_CONSTANT uint no_source = 0xffffffffU;

// The ramp of a tonal art map is a table. For a darkness from 0 to 1, the table gives the value whose mean
// ink is that darkness: a threshold, or a tone counted from 0 for paper. `ramp_steps` rows cover the blend
// from a mip level to the next coarser level. The first block of rows blends the finest level with itself at
// half the size; one block per level follows.
SHARED_CONSTANT uint ramp_length = 256U;
SHARED_CONSTANT uint ramp_steps = 8U;

// Variant bits (features that are compiled into a shader) of darkness.comp.
SHARED_CONSTANT uint darkness_has_fade = 1U << 0U;   // strokes fade with the distance from the eye
SHARED_CONSTANT uint darkness_has_screen = 1U << 1U; // the scene has transparent surfaces
// The shader handles only the surfaces of one style variant (the style of certain materials or objects).
SHARED_CONSTANT uint darkness_has_variants = 1U << 2U;
// Keeps the ink of style variants (styles of certain materials or objects) that were drawn before.
SHARED_CONSTANT uint darkness_keeps_ink = 1U << 3U;

// Variant bit (compiled-in feature) of overrun.comp: the first step of the flooding, in which each pixel is
// its own source.
SHARED_CONSTANT uint overrun_is_first = 1U << 0U;

// Variant bits (features that are compiled into a shader) of lines.comp and trace.comp.
SHARED_CONSTANT uint lines_has_growth = 1U << 0U;  // strokes that appear grow in length
SHARED_CONSTANT uint lines_has_overrun = 1U << 1U; // strokes run over silhouettes onto blank paper
// Runs one workgroup for every tile of the page, also for blank tiles.
SHARED_CONSTANT uint lines_has_all_tiles = 1U << 2U;
// Strokes along the light follow the strongest lamp at each place.
SHARED_CONSTANT uint lines_has_local_light = 1U << 3U;
// Adds to the ink of style variants (styles of certain materials or objects) that were drawn before.
SHARED_CONSTANT uint lines_has_ink = 1U << 4U;
// Position of the bits for kinds of stroke, one bit per kind, see stroke_kind.glsl.h.
SHARED_CONSTANT uint lines_kinds_shift = 8U;

// Variant bits (features that are compiled into a shader) of map.comp.
SHARED_CONSTANT uint map_tone_mask = 3U;
SHARED_CONSTANT uint map_in_order = 0U;  // a darker tone adds stroke after stroke, by the map's thresholds
SHARED_CONSTANT uint map_in_blends = 1U; // two neighbouring tones are blended
SHARED_CONSTANT uint map_in_steps = 2U;  // each pixel shows only the nearer of two tones
SHARED_CONSTANT uint map_has_overrun = 1U << 2U;
// Adds to the ink of style variants (styles of certain materials or objects) that were drawn before.
SHARED_CONSTANT uint map_has_ink = 1U << 3U;

// Variant bit (compiled-in feature) of dots.comp: adds to the ink of style variants (styles of certain
// materials or objects) that were drawn before.
SHARED_CONSTANT uint dots_has_ink = 1U << 0U;

struct DarknessConstants {
    ToneConstants tone;
    float fade; // share of the darkness that is left at infinite distance; 1 means no fade
    float fade_distance_m;
    // Number of the style variant (the style of certain materials or objects) whose surfaces are handled.
    uint style_variant;
};

struct LineConstants {
    uvec2 size_px;
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    // Shortest distance between two stroke ends on one line; the longest distance is twice that.
    float cell_px;
    float pressure;
    float growth;
    float black_above; // darkness above which ink fills the paper completely
    uint layers;
    uint seed;
    vec2 flat_axis_0; // axis across the strokes of the first layer, for strokes in UV space or on the page
    vec2 flat_axis_1;
    vec2 flat_axis_2;
    vec2 wind; // unit vector of the wind's horizontal direction, as (x, z)
    vec2 ground_wind;
    vec3 towards_light;
    float overrun_px; // distance by which strokes run over silhouettes
};

// Largest share of the remaining darkness that a layer of strokes draws if another layer follows.
#ifdef __cplusplus
inline constexpr float first_layer_share = 0.46F;
inline constexpr float next_layer_share = 0.50F;
#else
#define FIRST_LAYER_SHARE 0.46
#define NEXT_LAYER_SHARE 0.50
#endif

// Constants of overrun.comp, which finds for each pixel the pixels whose strokes run over into it.
struct OverrunConstants {
    uvec2 size_px;
    int step_px;
};

struct MapConstants {
    uvec2 size_px;
    uint map_size_texels;
    uint tone_count;
    uint level_count;
    float texels_per_px; // texels of the map's finest level per pixel of the page
    // Factor on the contrast of the tones about middle grey; 1 leaves the tones unchanged.
    float contrast;
    float black_above;
    float overrun_px;
};

struct DotConstants {
    float pitch_px;
    vec2 axis;  // direction of the dots' lattice on the page, a unit vector
    uint steps; // number of tones to which darkness is rounded; 0 means no rounding
    float black_above;
};

// A point where the centre line of a stroke passes between the centres of two neighbouring pixels.
struct Crossing {
    // 2 * index of the first pixel; plus 1 if the second pixel lies below, plus 0 if it lies to the right.
    uint edge;
    uint draw; // number of the draw call, plus 1
    // Bits 0-7: family of strokes; from bit 8: exponent + 128; the line's coordinate is number * 2^exponent.
    uint line;
    int number; // number of the line: odd, or 0
    // Low half: position between the two pixels, 0 to 65535; high half: width in pixels, as a half float.
    uint place_and_width;
};

#ifdef __cplusplus
static_assert(sizeof(Crossing) == 20);
} // namespace estampe::shared
#endif

#endif
