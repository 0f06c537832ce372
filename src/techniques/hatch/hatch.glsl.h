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

// Value in the image of overrun.comp: no strokes of another pixel extend into the pixel.
SHARED_CONSTANT uint no_source = 0xffffffffU;

// The ramp of a tonal art map is a table. The table converts a wanted darkness, from 0 to 1, to the value to
// look up in the map: a threshold, or a tone counted from 0 for paper. Drawn with that value, the map's mean
// ink is the wanted darkness. `ramp_steps` rows cover the blend from a mip level to the next coarser level.
// The first block of rows blends the finest mip level with that level repeated at half the size; one block
// per mip level follows.
SHARED_CONSTANT uint ramp_length = 256U;
SHARED_CONSTANT uint ramp_steps = 8U;

// Variant bits: each bit compiles one feature into the shader darkness.comp.
SHARED_CONSTANT uint darkness_has_fade = 1U << 0U;   // strokes fade with the distance from the eye
SHARED_CONSTANT uint darkness_has_screen = 1U << 1U; // the scene has transparent surfaces
// The shader handles only the surfaces of one style variant (the style of certain materials or objects).
SHARED_CONSTANT uint darkness_has_variants = 1U << 2U;
// The shader keeps the ink of style variants (styles of certain materials or objects) that were drawn earlier
// in the frame.
SHARED_CONSTANT uint darkness_keeps_ink = 1U << 3U;
// Surfaces are hatched more or less densely where they turn away from the sun, where something else shuts the
// sun off, and where they are level.
SHARED_CONSTANT uint darkness_has_causes = 1U << 4U;

// The darkness is grouped into areas of one tone afterwards, by groups.comp: the shader writes `not_hatched`
// where a pixel has no surface to hatch, and lists no tiles.
SHARED_CONSTANT uint darkness_is_grouped = 1U << 5U;
SHARED_CONSTANT uint darkness_has_halo = 1U << 6U; // strokes thin out around things, see techniques/halo

// Value in the image of darkness.comp of pixels without a surface to hatch, if the darkness is grouped.
SHARED_CONSTANT float not_hatched = -1.0F;

// Largest number of tones into which the darkness is grouped.
SHARED_CONSTANT uint most_groups = 6U;

#ifndef __cplusplus
// The tone, of `count` tones counted from 0 for paper, to which a darkness is rounded.
uint group_of(float dark, uint count)
{
    return uint(clamp(dark, 0.0, 1.0) * float(count - 1u) + 0.5);
}

// Darkness of a tone, of `count` tones counted from 0 for paper.
float tone_of_group(uint group, uint count)
{
    return float(group) / float(count - 1u);
}
#endif

// The steps of groups.comp, as the shader's variant: each step is one dispatch over the page.
SHARED_CONSTANT uint groups_start = 0U;   // each tile of 8 x 8 pixels is divided into areas of one tone
SHARED_CONSTANT uint groups_unite = 1U;   // touching areas of one tone become one area
SHARED_CONSTANT uint groups_measure = 2U; // pixels of each area are counted
SHARED_CONSTANT uint groups_borders = 3U; // borders of small areas are counted, by the tone beyond the border

// Variant bit (compiled-in feature) of overrun.comp: the first step of the jump flooding, in which each pixel
// draws strokes only from itself.
SHARED_CONSTANT uint overrun_is_first = 1U << 0U;

// Variant bits: each bit compiles one feature into the shaders lines.comp and trace.comp.
SHARED_CONSTANT uint lines_has_growth = 1U << 0U;  // strokes that appear grow in length
SHARED_CONSTANT uint lines_has_overrun = 1U << 1U; // strokes run over silhouettes onto blank paper
// One workgroup runs for every tile of the page, including blank tiles.
SHARED_CONSTANT uint lines_has_all_tiles = 1U << 2U;
// Strokes along the light follow the strongest lamp at each place.
SHARED_CONSTANT uint lines_has_local_light = 1U << 3U;
// The shader adds its strokes to the ink of other style variants (styles of certain materials or objects),
// drawn earlier in the frame.
SHARED_CONSTANT uint lines_has_ink = 1U << 4U;
// Where ink fills the paper completely, the shader writes `solid_ink`.
SHARED_CONSTANT uint lines_marks_solid = 1U << 5U;
// Strokes end at random before or beyond the edge of a tone.
SHARED_CONSTANT uint lines_has_loose_ends = 1U << 6U;
// Position of the bits for kinds of stroke, one bit per kind, see stroke_kind.glsl.h.
SHARED_CONSTANT uint lines_kinds_shift = 8U;

// Variant bits: each bit compiles one feature into the shader map.comp.
SHARED_CONSTANT uint map_tone_mask = 3U;
SHARED_CONSTANT uint map_in_order = 0U;  // a darker tone adds stroke after stroke, by the map's thresholds
SHARED_CONSTANT uint map_in_blends = 1U; // two neighbouring tones are blended
SHARED_CONSTANT uint map_in_steps = 2U;  // each pixel shows only one tone, the nearer of two tones
SHARED_CONSTANT uint map_has_overrun = 1U << 2U;
// The shader adds its strokes to the ink of other style variants (styles of certain materials or objects),
// drawn earlier in the frame.
SHARED_CONSTANT uint map_has_ink = 1U << 3U;
// Where ink fills the paper completely, the shader writes `solid_ink`.
SHARED_CONSTANT uint map_marks_solid = 1U << 4U;

// Variant bit (compiled-in feature) of dots.comp: the shader adds its dots to the ink of other style variants
// (styles of certain materials or objects), drawn earlier in the frame.
SHARED_CONSTANT uint dots_has_ink = 1U << 0U;
// Where ink fills the paper completely, the shader writes `solid_ink`.
SHARED_CONSTANT uint dots_marks_solid = 1U << 1U;

struct DarknessConstants {
    ToneConstants tone;
    float fade; // share of the darkness that remains at infinite distance; 1 means no fade
    float fade_distance_m;
    // Number of the style variant (the style of certain materials or objects) whose surfaces are handled.
    uint style_variant;
    // Layers of ink that replace one layer: where surfaces turn away from the sun, where something shuts the
    // sun off, and besides on level surfaces. 0 leaves them blank, 1 leaves the tone as it is.
    float form_shade;
    float cast_shade;
    float ground_shade;
    float under_shade;  // besides on surfaces in shade that face down
    uvec2 ground_draws; // draw calls of the ground and the terrain; UINT_MAX where there is none
    float halo_px;      // width of the halo in which strokes of the ground thin out
    uint group_count;   // number of tones into which the darkness is grouped; 0: none
    float group_strength;
};

struct GroupConstants {
    uvec2 size_px;
    uint count; // number of tones, at most most_groups
    float strength;
    float least_px;  // smallest area that keeps its tone
    float smooth_px; // radius over which the darkness is smoothed before it is grouped
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
    float loose_px;   // largest distance between a stroke's end and the edge of a tone
};

// Largest share of the remaining darkness that one layer of strokes may draw if another layer follows.
#ifdef __cplusplus
inline constexpr float first_layer_share = 0.46F;
inline constexpr float next_layer_share = 0.50F;
#else
#define FIRST_LAYER_SHARE 0.46
#define NEXT_LAYER_SHARE 0.50
#endif

// Constants of overrun.comp, which finds for each pixel the pixels whose strokes run over into the pixel.
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
    // The pair of pixels: 2 * index of the first pixel, plus 1 if the second pixel lies below, plus 0 if it
    // lies to the right.
    uint edge;
    uint draw; // number of the draw call, plus 1
    // Bits 0-7: number of the set of parallel strokes. Bits from 8 on: exponent + 128. The line lies at the
    // stroke coordinate number * 2^exponent.
    uint line;
    int number; // factor of 2^exponent in the line's coordinate: odd, or 0
    // Lower 16 bits: position between the two pixels, 0 to 65535. Upper 16 bits: width in pixels, as a half
    // float.
    uint place_and_width;
};

#ifdef __cplusplus
static_assert(sizeof(Crossing) == 20);
} // namespace estampe::shared
#endif

#endif
