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
SHARED_CONSTANT uint ink_map_side = 64U;     // nodes of a flow map's stream function, each way
SHARED_CONSTANT uint ink_node_cells = 4U;    // from one node of the stream function to the next
SHARED_CONSTANT uint ink_gutter = 3U;        // cells that a face of the cube has beyond each edge
SHARED_CONSTANT uint ink_strip = 8U;         // cells of a column that one thread gives to, on processors
SHARED_CONSTANT uint ink_block = 8U;         // pixels that one thread measures
SHARED_CONSTANT float ink_measured = 255.0F; // what a covered cell counts

// Variant bits of the shaders.
SHARED_CONSTANT uint ink_is_around = 1U << 0U;       // the grid is a cube around the eye
SHARED_CONSTANT uint ink_has_map = 1U << 1U;         // a picture says where ink flows
SHARED_CONSTANT uint ink_has_zones = 1U << 2U;       // so do objects
SHARED_CONSTANT uint ink_is_moved = 1U << 3U;        // the camera or the scene has moved since
SHARED_CONSTANT uint ink_on_surface = 1U << 4U;      // ink lies at the depth of what is seen
SHARED_CONSTANT uint ink_has_motion = 1U << 5U;      // some of the scene moved by itself
SHARED_CONSTANT uint ink_keeps_depth = 1U << 6U;     // for the picture after this one
SHARED_CONSTANT uint ink_has_mask = 1U << 7U;        // not all objects give ink
SHARED_CONSTANT uint ink_spots_on_things = 1U << 8U; // they stay on what is drawn
SHARED_CONSTANT uint ink_from_strokes = 1U << 9U;    // dark strokes give ink
SHARED_CONSTANT uint ink_from_light = 1U << 10U;     // what is bright does; else whatever is there
SHARED_CONSTANT uint ink_in_strips = 1U << 11U;      // a processor looks for what gives

// One term of the stream function: amplitude * sin(2 pi (dot(wave, place) + phase)).
struct InkWave {
    vec3 wave;       // turns a millimetre; around the eye, a radian
    float amplitude; // square millimetres a second; radians
};

// Where an object drives the ink, and gives some.
struct InkZone {
    vec2 middle_mm; // on the page
    float radius_mm;
    float amount; // of what the drawing gives there, how much is taken
    vec2 velocity_mm_per_s;
    float turn_rad_s; // about its middle, clockwise on the page
    float gives;      // 0 to 1: ink of its own
};

// What holds for all steps of a picture.
struct InkGlobals {
    mat4 before_from_clip; // where on the page of the picture before a place of this one's clip space was
    vec3 wind_axis;        // around the eye, radians a second
    uint face_side;        // cells of a face of the cube without gutters
    InkWave waves[ink_wave_count];
    InkZone zones[most_ink_zones];
    uint zone_count;
    uvec2 grid_size;   // cells
    uvec2 page_px;     // the whole page
    uvec2 measured_px; // of the page that what it covers is measured on
    vec2 margin_cells; // of the grid, beyond the page's left and upper edge
    float cells_per_px;
    float mm_per_cell;
    float px_per_mm;
    vec2 wind_mm_per_s;
    float plane_depth; // reversed depth at which ink lies, unless on surfaces
    float drag;        // of what moves by itself, the share that ink follows
    float map_mm_per_s;
    vec2 page_mm;
    // What is given, and where: within the page's margin.
    vec2 window_min_px;
    vec2 window_max_px;
    float threshold;
    float spot_mm;
    float spacing_mm;
    uint seed;
    // How it looks.
    float thin; // ink below this is not seen
    float full; // and above this is seen in full
    float opacity;
    float edge;
    float budget;
    vec3 color;
    vec3 thin_color;
    vec2 clip_min_px; // there is no ink beyond
    vec2 clip_max_px;
};

// What differs from step to step.
struct InkStep {
    float phases[ink_wave_count];       // turns
    float zone_streams[most_ink_zones]; // the stream function in the middle of each zone
    float seconds;
    float left;       // share of the wet ink that stays wet
    float stain_left; // share of the dry ink that stays
    float soak;       // share of the wet ink that dries into the paper
    float given;      // share of what is missing that a spot fills up
    float keeps;      // 0: there was no ink before
    uint sum_before;  // which of the two sums is of the ink before this step
    uint sum_now;     // which is of the ink after it; neither where that is not measured
};

// When it is, in lives of a spot.
struct InkSpots {
    float share; // of the life that runs where none is delayed
    uint round;  // lives before that
};

struct InkSums {
    uint covered[2]; // by the ink after the last step, and the one before: ink_measured a cell
};

struct InkMeasure {
    uint sum_now;
};

#ifdef __cplusplus
static_assert(sizeof(InkStep) <= 128);
} // namespace estampe::shared
#endif

#endif
