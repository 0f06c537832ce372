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

SHARED_CONSTANT uint smoke_brick = 8U;       // cells along each side of what is skipped where it is empty
SHARED_CONSTANT uint smoke_light_cells = 2U; // cells along each side of one of the light's
SHARED_CONSTANT uint smoke_most_lights = 4U;

// A light in the grid's axes.
struct SmokeLight {
    vec3 place;     // in cells; of a directional light, a unit vector towards it
    float strength; // at the middle of the box, of all light that comes there unhindered
    float range_m;  // 0: directional
    float falloff;  // makes strength / distance^2 that share
    vec3 beam;      // of spots, along it
    float cone_scale;
    float cone_offset;
};

// The box and what is in it.
struct SmokeGlobals {
    mat4 grid_from_anchor; // in cells, from the low corner
    uvec3 cells;
    float cell_m;
    float extinction_per_m; // of density 1
    float puff_cells;       // from one puff to the next
    vec3 puffs_risen;       // cells that all of them have gone
    vec3 puffs_from;        // whole numbers of the first that may reach into the box
    uvec3 puff_counts;      // from there on
    SmokeLight lights[smoke_most_lights];
    uint light_count;
    float ambient; // of all light that comes unhindered
    float edge;    // opacity at which smoke begins to be drawn
    float step_m;
    float scatter;      // of look-ups within a step, 0 to 1
    vec3 towards_light; // in the grid's axes, of what gives form
    uint seed;
};

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
    float gap_m;         // depth between puffs from which a line parts them
    vec3 stroke_axis;    // across the strokes
    float stroke_rise_m; // how far they have risen
};

#ifdef __cplusplus
static_assert(sizeof(SmokeInk) <= 128);
} // namespace estampe::shared
#endif

#endif
