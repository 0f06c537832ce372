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
SHARED_CONSTANT uint smoke_by_axis = 1U << 1U;     // samples on planes of the grid
SHARED_CONSTANT uint smoke_by_view = 1U << 2U;     // samples on planes that face the eye
SHARED_CONSTANT uint smoke_has_wash = 1U << 3U;    // paint shows the tones
SHARED_CONSTANT uint smoke_has_strokes = 1U << 4U; // strokes show the tones
SHARED_CONSTANT uint smoke_has_several = 1U << 5U; // there are several boxes
SHARED_CONSTANT uint smoke_is_shaded = 1U << 6U;   // the scene's shadows fall on the smoke
SHARED_CONSTANT uint smoke_has_share = 1U << 7U;   // other occluders have a share of sunlight, too
SHARED_CONSTANT uint smoke_has_haze = 1U << 8U;
SHARED_CONSTANT uint smoke_has_fire = 1U << 9U;
SHARED_CONSTANT uint smoke_has_cloud = 1U << 10U;

SHARED_CONSTANT uint smoke_brick = 8U;       // cells per side of a brick, which is skipped if empty
SHARED_CONSTANT uint smoke_light_cells = 2U; // cells per side of a cell of the light grid
SHARED_CONSTANT uint smoke_most_lights = 4U;
SHARED_CONSTANT uint smoke_most_boxes = 8U;

// The shadow map of a light: none, the sun's, or the local light's with this value minus smoke_local_shadow.
SHARED_CONSTANT uint smoke_no_shadow = 0U;
SHARED_CONSTANT uint smoke_sun_shadow = 1U;
SHARED_CONSTANT uint smoke_local_shadow = 2U;
// Lattice of puffs: the smallest distance of a puff's centre from its lattice cell's faces, and the largest
// radius of a puff, as shares of the spacing.
SHARED_CONSTANT float smoke_least_stray = 0.2F;
SHARED_CONSTANT float smoke_most_puff = 0.95F;

// A light in the grid's axes.
struct SmokeLight {
    vec3 place;     // in cells; for a directional light, a unit vector towards it
    float strength; // share of all unobstructed light at the middle of the box
    float range_m;  // 0: directional
    float falloff;  // factor that turns strength / distance^2 into that share
    vec3 beam;      // direction of a spot's beam
    float cone_scale;
    float cone_offset;
    uint shadow;
};

// A box and its contents. The fields of all boxes are stored in images of one common size. Each box's layers
// begin at a whole brick.
struct SmokeBox {
    mat4 grid_from_anchor; // in cells, from the low corner
    mat4 anchor_from_grid;
    uvec3 cells;
    uint first_layer;
    float cell_m;
    float extinction_per_m; // for density 1
    float puff_cells;       // distance between puffs
    vec3 puffs_risen;       // cells that all puffs have moved
    vec3 puffs_from;        // integer lattice position of the first puff that may reach into the box
    uvec3 puff_counts;      // number of puffs from there
    SmokeLight lights[smoke_most_lights];
    uint light_count;
    float ambient; // share of all unobstructed light
    float step_m;
    vec3 towards_light;  // towards the strongest light, in the grid's axes, for shading by form
    float gap_m;         // depth difference from which a line separates puffs
    float stroke_rise_m; // distance that strokes have risen
    uint seed;
};

struct SmokeGlobals {
    SmokeBox boxes[smoke_most_boxes];
    uint box_count;
    uvec3 field_cells; // size of the images
    float edge;        // opacity at which the drawn smoke begins
    float scatter;     // random offset of samples within a step, 0 to 1
};

// The box of a dispatch.
struct SmokeTurn {
    uint box;
};

// Constants of smoke_seen.comp, which converts a box's quantities to density and fire. Each channel has
// `cells.z` layers.
struct SmokeSeen {
    uvec3 cells;
    float ignition; // temperature from which fuel burns
    float flame;    // density of flames per unit of fuel
};

// Channels of the quantities, as in the fluid simulation.
SHARED_CONSTANT uint smoke_temperature = 1U;
SHARED_CONSTANT uint smoke_fuel = 2U;
SHARED_CONSTANT uint smoke_cloud = 4U;
// Light of a flame, as a multiple of all unobstructed light: flames outshine lamps.
SHARED_CONSTANT float smoke_flame_light = 32.0F;

// The appearance of smoke.
struct SmokeInk {
    vec3 color;
    float shade_below; // share of all light
    vec3 shade_color;
    float deep_below;
    vec3 deep_color;
    float opacity;
    float form; // weight of a puff's orientation in its tone
    float line_px;
    float scene_line_px; // half the widest line of the scene
    float stroke_px;
    float darkness;
    vec3 stroke_axis; // direction across the strokes
    // See haze.glsl.h.
    float haze_start_m;
    float haze_halves_per_m;
    float haze_ink;
    vec3 flame_color;
};

// The shadow of smoke on the scene.
struct SmokeThrown {
    vec3 towards_sun;
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(SmokeInk) <= 128);
} // namespace estampe::shared
#endif

#endif
