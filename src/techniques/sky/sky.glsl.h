// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SKY_GLSL_H
#define ESTAMPE_SKY_GLSL_H
// Data that the shaders of sky and clouds share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sky_has_tiles = 1U << 0U; // variant bit of sky.comp: paints only listed tiles
SHARED_CONSTANT uint sky_has_depth = 1U << 1U; // variant bit of sky.comp: skips pixels with near surfaces

struct SkyConstants {
    vec3 horizon_color;
    float stroke_width_px;
    vec3 zenith_color;
    float darkness; // darkness of the strokes at the zenith, away from the sun
    vec3 towards_sun;
    vec3 high_color; // colour of the high band
    float high_rad;  // elevation of the middle of the high band's edge
    vec3 low_color;
    float low_rad;
    vec3 disc_color;
    float disc_rad; // angular radius of the disc; 0: none
    vec3 towards_disc;
    float disc_lit; // lit share of the disc's width
    float steps;    // number of flat tones; 0: a smooth gradient
    float far_m;    // for sky_has_depth: distance from the eye beyond which sky is painted
};

// Variant bits of clouds.comp.
SHARED_CONSTANT uint clouds_have_hatching = 1U << 0U;
SHARED_CONSTANT uint clouds_have_streaks = 1U << 1U;

SHARED_CONSTANT uint clouds_have_share = 1U << 2U; // other occluders have a share of sunlight, too
SHARED_CONSTANT uint clouds_keep_cover = 1U << 3U; // also outputs the clouds' coverage
SHARED_CONSTANT uint clouds_have_tiles = 1U << 4U; // paints only listed tiles
SHARED_CONSTANT uint clouds_have_depth = 1U << 5U; // skips pixels with near surfaces
SHARED_CONSTANT uint clouds_by_groups = 1U << 6U;  // the pixels of a workgroup find their puffs together

SHARED_CONSTANT uint most_puff_layers = 2U;
SHARED_CONSTANT float puff_wavers = 1.2F; // reach of a wavering outline, in radii of its puff

// Layer space: along the wind, above the base, across the wind, in cells. A tile of `cells` x `cells`
// repeats. Puffs are balls in layer space, but may be flat or long in metres.

// A ball of cloud: two texels of four floats.
struct CloudPuff {
    vec3 centre; // in layer space, on the tile or next to it
    float radius;
    vec3 lean;   // unit vector, in metres: the direction that the cloud mass around it faces
    float trait; // random number of the puff, 0 to 1
};

// A layer of puffs, cut flat by its base.
struct PuffLayer {
    vec3 eye;      // in layer space, on the tile
    float base_m;  // height of the base above the eye
    vec3 per_m;    // factor from metres to layer space
    float thick_m; // thickness of the layer's slab
    float pen;     // factor on the outlines' width
    float under;   // how much less light the base receives
    uint cells;
    uint first_cell; // first cell in the list of starts, for puffs that touch a cell
    uint first_home; // first cell in the list of starts, for puffs with their centre in a cell
    float reach;     // reach of the largest puff, in cells
};

// White strokes on a plane; their density is stored at the corners of cells.
struct StreakLayer {
    vec2 eye; // along and across the wind, in cells, on the tile
    float base_m;
    float cell_m;
    uint cells;
    float width_px;
};

struct CloudGlobals {
    PuffLayer puffs[most_puff_layers]; // lowest layer first
    StreakLayer streaks;
    uint puff_layer_count;
    vec2 along_wind;  // x and z of a unit vector
    vec3 towards_sun; // in the wind's axes: along, up, across
    vec3 lit_color;   // transmittance of the paint
    vec3 middle_color;
    vec3 shade_color;
    float shade_below; // surfaces with less light than this are shaded
    float middle_band; // width of the middle tone below `shade_below`
    float outline_px;
    float broken; // share of an outline's lit side that is left out
    float hatch_darkness;
    float hatch_width_px;
    float reach_m; // distance at which clouds have dissolved
};

// Constants of clouds.comp, for clouds_have_depth.
struct CloudCover {
    float far_m; // distance from the eye; nearer surfaces show no clouds
};

struct CloudShadow {
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(CloudPuff) == 32);
} // namespace estampe::shared
#endif

#endif
