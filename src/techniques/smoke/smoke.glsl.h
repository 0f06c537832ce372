// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_GLSL_H
#define ESTAMPE_SMOKE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of the shaders.
SHARED_CONSTANT uint smoke_has_puffs = 1U << 0U;
SHARED_CONSTANT uint smoke_by_axis = 1U << 1U;     // looked up in planes of the grid
SHARED_CONSTANT uint smoke_by_view = 1U << 2U;     // looked up in planes that face the eye
SHARED_CONSTANT uint smoke_has_wash = 1U << 3U;    // tones are paint
SHARED_CONSTANT uint smoke_has_strokes = 1U << 4U; // tones are strokes
SHARED_CONSTANT uint smoke_has_several = 1U << 5U; // boxes
SHARED_CONSTANT uint smoke_is_shaded = 1U << 6U;   // by what stands in the light's way
SHARED_CONSTANT uint smoke_has_share = 1U << 7U;   // of the sun, that something else leaves
SHARED_CONSTANT uint smoke_has_haze = 1U << 8U;
SHARED_CONSTANT uint smoke_has_fire = 1U << 9U;
SHARED_CONSTANT uint smoke_has_cloud = 1U << 10U;

SHARED_CONSTANT uint smoke_brick = 8U;       // cells along each side of what is skipped where it is empty
SHARED_CONSTANT uint smoke_light_cells = 2U; // cells along each side of one of the light's
SHARED_CONSTANT uint smoke_most_lights = 4U;
SHARED_CONSTANT uint smoke_most_boxes = 8U;

// Who knows what stands before a light: nobody, the sun's map, or the local light's from this number on.
SHARED_CONSTANT uint smoke_no_shadow = 0U;
SHARED_CONSTANT uint smoke_sun_shadow = 1U;
SHARED_CONSTANT uint smoke_local_shadow = 2U;
// Of the lattice that puffs stand on: how far a middle is from the planes of knots about it at least, and how
// large a puff is at most.
SHARED_CONSTANT float smoke_least_stray = 0.2F;
SHARED_CONSTANT float smoke_most_puff = 0.95F;

// A light in the grid's axes.
struct SmokeLight {
    vec3 place;     // in cells; of a directional light, a unit vector towards it
    float strength; // at the middle of the box, of all light that comes there unhindered
    float range_m;  // 0: directional
    float falloff;  // makes strength / distance^2 that share
    vec3 beam;      // of spots, along it
    float cone_scale;
    float cone_offset;
    uint shadow;
};

// A box and what is in it. Fields of all boxes lie in images of one size, layer after layer, each from a
// whole brick on.
struct SmokeBox {
    mat4 grid_from_anchor; // in cells, from the low corner
    mat4 anchor_from_grid;
    uvec3 cells;
    uint first_layer;
    float cell_m;
    float extinction_per_m; // of density 1
    float puff_cells;       // from one puff to the next
    vec3 puffs_risen;       // cells that all of them have gone
    vec3 puffs_from;        // whole numbers of the first that may reach into the box
    uvec3 puff_counts;      // from there on
    SmokeLight lights[smoke_most_lights];
    uint light_count;
    float ambient; // of all light that comes unhindered
    float step_m;
    vec3 towards_light;  // in the grid's axes, of what gives form
    float gap_m;         // depth between puffs from which a line parts them
    float stroke_rise_m; // how far strokes have risen
    uint seed;
};

struct SmokeGlobals {
    SmokeBox boxes[smoke_most_boxes];
    uint box_count;
    uvec3 field_cells; // of the images
    float edge;        // opacity at which smoke begins to be drawn
    float scatter;     // of look-ups within a step, 0 to 1
};

// Which box a dispatch is of.
struct SmokeTurn {
    uint box;
};

// What is seen of the quantities of a box: a layer for each channel and slice.
struct SmokeSeen {
    uvec3 cells;
    float ignition; // temperature from which on fuel is in flames
    float flame;    // of a unit of fuel
};

// Channels of the quantities, as the fluid has them.
SHARED_CONSTANT uint smoke_temperature = 1U;
SHARED_CONSTANT uint smoke_fuel = 2U;
SHARED_CONSTANT uint smoke_cloud = 4U;
// Of a flame, as a share of all that comes from outside: more than lamps bring.
SHARED_CONSTANT float smoke_flame_light = 32.0F;

// How it is inked.
struct SmokeInk {
    vec3 color;
    float shade_below; // share of the light
    vec3 shade_color;
    float deep_below;
    vec3 deep_color;
    float opacity;
    float form; // how far tone follows the way a puff faces
    float line_px;
    float scene_line_px; // half the widest line of the scene
    float stroke_px;
    float darkness;
    vec3 stroke_axis; // across the strokes
    // See haze.glsl.h.
    float haze_start_m;
    float haze_halves_per_m;
    float haze_ink;
    vec3 flame_color;
};

// Its shadow on the scene.
struct SmokeThrown {
    vec3 towards_sun;
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(SmokeInk) <= 128);
} // namespace estampe::shared
#endif

#endif
