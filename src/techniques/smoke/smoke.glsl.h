// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_GLSL_H
#define ESTAMPE_SMOKE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of the smoke shaders' `variant`.
SHARED_CONSTANT uint smoke_has_puffs = 1U << 0U;
SHARED_CONSTANT uint smoke_by_axis = 1U << 1U;     // samples along rays lie on planes of the smoke's grid
SHARED_CONSTANT uint smoke_by_view = 1U << 2U;     // samples along rays lie on planes that face the eye
SHARED_CONSTANT uint smoke_has_wash = 1U << 3U;    // paint (flat colour) shows the tones of smoke
SHARED_CONSTANT uint smoke_has_strokes = 1U << 4U; // strokes show the tones of smoke
SHARED_CONSTANT uint smoke_has_several = 1U << 5U; // there are several smoke boxes
SHARED_CONSTANT uint smoke_is_shaded = 1U << 6U;   // shadows of the scene fall on the smoke
// Terrain or clouds also shade the scene, so shares of sunlight are multiplied.
SHARED_CONSTANT uint smoke_has_share = 1U << 7U;
SHARED_CONSTANT uint smoke_has_haze = 1U << 8U;
SHARED_CONSTANT uint smoke_has_fire = 1U << 9U;
SHARED_CONSTANT uint smoke_has_cloud = 1U << 10U;

SHARED_CONSTANT uint smoke_brick = 8U;       // cells per side of a brick; rays skip empty bricks
SHARED_CONSTANT uint smoke_light_cells = 2U; // cells of smoke per side of a cell of the light grid
SHARED_CONSTANT uint smoke_most_lights = 4U;
SHARED_CONSTANT uint smoke_most_boxes = 8U;

// Number of a light's shadow map: no map, the sun's map, or from smoke_local_shadow on the maps of local
// lights.
SHARED_CONSTANT uint smoke_no_shadow = 0U;
SHARED_CONSTANT uint smoke_sun_shadow = 1U;
SHARED_CONSTANT uint smoke_local_shadow = 2U;
// Puffs are balls on a lattice that give smoke its drawn shape. As shares of the lattice's spacing: the
// smallest distance of a puff's centre from its cell's faces, and the largest radius of a puff.
SHARED_CONSTANT float smoke_least_stray = 0.2F;
SHARED_CONSTANT float smoke_most_puff = 0.95F;

// A light in the coordinates of a smoke box, in cells.
struct SmokeLight {
    vec3 place;     // place in cells; for a directional light, a unit vector towards it
    float strength; // the light's share of all unobstructed light, at the middle of the box
    float range_m;  // range of the light; 0: a directional light
    float falloff;  // factor that converts strength / distance^2 to the share of all light
    vec3 beam;      // direction of a spot's beam
    float cone_scale;
    float cone_offset;
    uint shadow;
};

// A smoke box and its contents. The fields of all boxes are stored in images of one common size. Each box's
// layers begin at a whole brick.
struct SmokeBox {
    mat4 grid_from_anchor; // transform from coordinates relative to a nearby origin to cells of the box
    mat4 anchor_from_grid;
    uvec3 cells;
    uint first_layer;
    float cell_m;
    float extinction_per_m; // extinction of light per metre, for smoke of density 1
    float puff_cells;       // distance between puffs, in cells
    vec3 puffs_risen;       // distance in cells that all puffs have risen
    vec3 puffs_from;        // integer lattice position of the first puff that may reach into the box
    uvec3 puff_counts;      // number of puffs along each axis, from `puffs_from` on
    SmokeLight lights[smoke_most_lights];
    uint light_count;
    float ambient; // ambient light as a share of all unobstructed light
    float step_m;
    vec3 towards_light;  // direction towards the strongest light, in the grid's axes, for shading of puffs
    float gap_m;         // depth difference at which a line separates two puffs
    float stroke_rise_m; // distance that strokes have risen with the smoke
    uint seed;
};

struct SmokeGlobals {
    SmokeBox boxes[smoke_most_boxes];
    uint box_count;
    uvec3 field_cells; // size of the field images
    float edge;        // opacity of smoke at which its drawn surface begins
    float scatter;     // random offset of ray samples within a step, 0 to 1
};

// Number of the smoke box that a dispatch processes.
struct SmokeTurn {
    uint box;
};

// Constants of smoke_seen.comp, which converts a box's quantities to density and fire. Each channel has
// `cells.z` layers.
struct SmokeSeen {
    uvec3 cells;
    float ignition; // lowest temperature at which fuel burns
    float flame;    // density of flames per unit of burning fuel
};

// Channels of the smoke's quantities, in the order of the fluid simulation.
SHARED_CONSTANT uint smoke_temperature = 1U;
SHARED_CONSTANT uint smoke_fuel = 2U;
SHARED_CONSTANT uint smoke_cloud = 4U;
// Light of a flame, as a multiple of all unobstructed light, because flames outshine lamps.
SHARED_CONSTANT float smoke_flame_light = 32.0F;

// The appearance of drawn smoke.
struct SmokeInk {
    vec3 color;
    float shade_below; // light below which smoke is in shade, as a share of all light
    vec3 shade_color;
    float deep_below;
    vec3 deep_color;
    float opacity;
    float form; // influence of a puff's orientation to the light on its tone
    float line_px;
    float scene_line_px; // half the width of the scene's widest line
    float stroke_px;
    float darkness;
    vec3 stroke_axis; // direction across the strokes of smoke
    // distance where haze starts, see haze.glsl.h
    float haze_start_m;
    float haze_halves_per_m;
    float haze_ink;
    vec3 flame_color;
};

// The shadow that smoke casts on the scene.
struct SmokeThrown {
    vec3 towards_sun;
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(SmokeInk) <= 128);
} // namespace estampe::shared
#endif

#endif
