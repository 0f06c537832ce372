// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SKY_GLSL_H
#define ESTAMPE_SKY_GLSL_H
// What the shaders of skies and clouds share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sky_has_tiles = 1U << 0U; // variant bit of sky.comp: only those of a list are painted
SHARED_CONSTANT uint sky_has_depth = 1U << 1U; // and nothing where something near is seen

struct SkyConstants {
    vec3 horizon_color;
    float stroke_width_px;
    vec3 zenith_color;
    float darkness; // of the strokes at the zenith, away from the sun
    vec3 towards_sun;
    vec3 high_color; // of the band above
    float high_rad;  // height of the middle of its edge
    vec3 low_color;
    float low_rad;
    vec3 disc_color;
    float disc_rad; // half the disc's width; 0 is none
    vec3 towards_disc;
    float disc_lit; // share of its width that shines
    float steps;    // flat tones; 0 is an even grade
    float far_m;    // from the eye: of the variant that knows of depth
};

// Variant bits of clouds.comp.
SHARED_CONSTANT uint clouds_have_hatching = 1U << 0U;
SHARED_CONSTANT uint clouds_have_streaks = 1U << 1U;

SHARED_CONSTANT uint clouds_have_share = 1U << 2U; // of the sun, that something else leaves
SHARED_CONSTANT uint clouds_keep_cover = 1U << 3U; // for a mask
SHARED_CONSTANT uint clouds_have_tiles = 1U << 4U; // only those of a list are painted
SHARED_CONSTANT uint clouds_have_depth = 1U << 5U; // and none over what is near
SHARED_CONSTANT uint clouds_by_groups = 1U << 6U;  // the pixels of a group find their puffs together

SHARED_CONSTANT uint most_puff_layers = 2U;
SHARED_CONSTANT float puff_wavers = 1.2F; // of a puff's radius: an outline wavers, and lies outside

// Space "layer": along the wind, above the base, across the wind, in cells, of which a tile of `cells` x
// `cells` repeats. Puffs, which may be flat or long in metres, are balls there.

// A ball of cloud: two texels of four floats.
struct CloudPuff {
    vec3 centre; // in the layer's space, on the tile or beside it
    float radius;
    vec3 lean;   // unit, in metres: where the mass about it faces
    float trait; // 0 to 1, its own
};

// The base cuts them flat.
struct PuffLayer {
    vec3 eye;      // in the layer's space, on the tile
    float base_m;  // above the eye
    vec3 per_m;    // the layer's space from metres
    float thick_m; // of the slab that holds them
    float pen;     // share of the outlines' width
    float under;   // how much less light their base has
    uint cells;
    uint first_cell; // in the list of starts, of the puffs that a cell meets
    uint first_home; // and of those whose middles it has
    float reach;     // of the largest puff, in cells
};

// Strokes of white on a plane; how dense they are is known at the corners of cells.
struct StreakLayer {
    vec2 eye; // along the wind and across, in cells, on the tile
    float base_m;
    float cell_m;
    uint cells;
    float width_px;
};

struct CloudGlobals {
    PuffLayer puffs[most_puff_layers]; // the lowest first
    StreakLayer streaks;
    uint puff_layer_count;
    vec2 along_wind;  // x and z of a unit vector
    vec3 towards_sun; // along the wind, up and across
    vec3 lit_color;   // what the paint lets through
    vec3 middle_color;
    vec3 shade_color;
    float shade_below; // what faces the light less than this is shaded
    float middle_band; // and of that all but this much is so fully
    float outline_px;
    float broken; // share of an outline's lit side that is left out
    float hatch_darkness;
    float hatch_width_px;
    float reach_m; // what is farther dissolves
};

// Of the variant that knows of depth.
struct CloudCover {
    float far_m; // what is nearer than that to the eye has no sky before it
};

struct CloudShadow {
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(CloudPuff) == 32);
} // namespace estampe::shared
#endif

#endif
