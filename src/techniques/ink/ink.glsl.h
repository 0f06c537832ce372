// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_GLSL_H
#define ESTAMPE_INK_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint ink_wave_count = 6U;
SHARED_CONSTANT uint most_ink_zones = 8U;
SHARED_CONSTANT uint most_ink_blasts = 4U;
SHARED_CONSTANT uint ink_shape_side = 64U;   // nodes per side of the field of a zone with the shape of a mesh
SHARED_CONSTANT uint ink_map_side = 64U;     // nodes per side of a flow map's stream function
SHARED_CONSTANT uint ink_node_cells = 4U;    // cells of ink between two nodes of the stream function
SHARED_CONSTANT uint ink_gutter = 3U;        // extra cells of a cube face beyond each edge
SHARED_CONSTANT uint ink_strip = 8U;         // cells of a column that one thread processes, on CPUs
SHARED_CONSTANT uint ink_block = 8U;         // pixels per thread of the pass that measures ink coverage
SHARED_CONSTANT float ink_measured = 255.0F; // count that stands for one cell fully covered by ink

// Bits of the ink shaders' `variant`.
SHARED_CONSTANT uint ink_is_around = 1U << 0U;   // the ink grid is a cube around the eye
SHARED_CONSTANT uint ink_has_map = 1U << 1U;     // a flow map (a picture of velocities) drives the ink
SHARED_CONSTANT uint ink_has_zones = 1U << 2U;   // zones around objects drive the ink
SHARED_CONSTANT uint ink_is_moved = 1U << 3U;    // the camera or the scene has moved since the last picture
SHARED_CONSTANT uint ink_on_surface = 1U << 4U;  // ink lies at the depth of the visible surfaces
SHARED_CONSTANT uint ink_has_motion = 1U << 5U;  // some objects moved since the last picture
SHARED_CONSTANT uint ink_keeps_depth = 1U << 6U; // the step stores surface depths for the next picture
SHARED_CONSTANT uint ink_has_mask = 1U << 7U;    // only some objects give ink
SHARED_CONSTANT uint ink_spots_on_things = 1U << 8U; // spots of ink stay on the objects, not on the page
SHARED_CONSTANT uint ink_from_strokes = 1U << 9U;    // dark hatching strokes give ink
// Bright places give ink; with neither ink_from_light nor ink_from_strokes, all objects give ink.
SHARED_CONSTANT uint ink_from_light = 1U << 10U;
SHARED_CONSTANT uint ink_in_strips = 1U << 11U;  // for CPUs: one thread processes a strip of cells
SHARED_CONSTANT uint ink_has_blasts = 1U << 12U; // blasts push the ink away from their middles

// One wave of the ink's stream function: amplitude * sin(2 pi (dot(wave, place) + phase)) at the position
// `place`.
struct InkWave {
    vec3 wave; // direction and turns per millimetre of the wave; around the eye, turns per radian
    // Amplitude of the wave, in square millimetres per second; around the eye, in square radians per second.
    float amplitude;
};

// An area where an object drives the ink, and may give ink: a disc, or the area that a mesh covers.
struct InkZone {
    vec2 middle_mm;  // middle of the zone on the page
    float radius_mm; // radius of the disc, or of a disc with the area of the mesh's zone
    float amount;    // factor on the ink that the drawing gives in the zone
    vec2 velocity_mm_per_s;
    float turn_rad_s; // rotation of the flow about the zone's middle, clockwise on the page
    float gives;      // ink that the zone itself emits, 0 to 1
    uint shape;       // 0: a disc; otherwise one more than the number of the zone's field of distances
    vec2 shape_min_mm;
    vec2 shape_size_mm;
};

// Constants of all ink steps of a picture.
struct InkGlobals {
    // Transform from the current picture's clip space to the page of the previous picture.
    mat4 before_from_clip;
    vec3 wind_axis; // rotation of the wind around the eye, in radians per second
    uint face_side; // cells per side of a cube face without gutters
    InkWave waves[ink_wave_count];
    InkZone zones[most_ink_zones];
    uint zone_count;
    uvec2 grid_size;   // number of cells along x and y
    uvec2 page_px;     // size of the whole page in pixels
    uvec2 measured_px; // size of the page on which ink coverage is measured
    vec2 margin_cells; // number of cells beyond the page's left and upper edge
    float cells_per_px;
    float mm_per_cell;
    float px_per_mm;
    vec2 wind_mm_per_s;
    float plane_depth; // reversed depth of the plane that ink lies on, unless it lies on surfaces
    float drag;        // share of the objects' own motion that ink follows
    float map_mm_per_s;
    vec2 page_mm;
    // The rectangle of the page where ink may start: inside the page's margin.
    vec2 window_min_px;
    vec2 window_max_px;
    float threshold;
    float spot_mm;
    float spacing_mm;
    uint seed;
    // The appearance of flowing ink.
    float thin; // amount of ink below which ink is invisible
    float full; // amount of ink above which ink has full opacity
    float opacity;
    float edge;
    float budget;
    vec3 color;
    vec3 thin_color;
    vec2 clip_min_px; // upper left corner of the rectangle outside which no ink is drawn
    vec2 clip_max_px;
    vec2 blasts_mm[most_ink_blasts]; // middles of blasts on the page
    uint blast_count;
};

// Constants of one ink step.
struct InkStep {
    float phases[ink_wave_count];       // phases of the waves at the time of the step, in turns
    float zone_streams[most_ink_zones]; // value of the stream function in the middle of each zone
    float seconds;
    float left;       // share of the wet ink that stays wet
    float stain_left; // share of the dry ink that stays
    float soak;       // share of the wet ink that dries into the paper
    float given;      // share of the missing ink that a spot adds in the step
    float keeps;      // 1: ink existed before the step; 0: there was no ink
    uint sum_before;  // index of the coverage sum of the ink before the step
    uint sum_now;     // index of the coverage sum of the ink after the step; 2: not measured
    // Cubed radius of each blast on the page before the step, then after the step, in cubic millimetres.
    vec2 blast_cubes_mm3[most_ink_blasts];
};

// The current time, in lifetimes of an ink spot.
struct InkSpots {
    float share; // elapsed share of the current lifetime, for a spot without delay
    uint round;  // number of complete lifetimes before the current one
};

// A word of ink_corners.comp: the ink given in a cell and its three neighbours to the right and below, and
// the rank of the spot that gives most.
SHARED_CONSTANT uint ink_corner_bits = 6U;
SHARED_CONSTANT uint ink_corner_most = 63U;
SHARED_CONSTANT uint ink_rank_shift = 24U;

struct InkSums {
    uint covered[2]; // covered area after the last two steps, in units of ink_measured per cell
};

struct InkMeasure {
    uint sum_now;
};

#ifdef __cplusplus
static_assert(sizeof(InkStep) <= 128);
} // namespace estampe::shared
#endif

#endif
