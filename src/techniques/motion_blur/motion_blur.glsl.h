// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MOTION_BLUR_GLSL_H
#define ESTAMPE_MOTION_BLUR_GLSL_H
// Constants and structs of motion blur, speed lines and smear strokes, shared by shaders and C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of the motion blur shaders.
SHARED_CONSTANT uint blur_has_sky = 1U << 0U; // the sky's strokes are drawn where no surface is visible
SHARED_CONSTANT uint blur_shows_velocity = 1U << 1U;
SHARED_CONSTANT uint blur_is_stretched = 1U << 2U; // shapes are stretched along their motion
SHARED_CONSTANT uint blur_lays_sky = 1U << 3U;     // the sky's strokes are added to the hatching

SHARED_CONSTANT uint blur_tile_px = 16U;
SHARED_CONSTANT float blur_still_px = 0.25F; // a smaller displacement counts as standing still
SHARED_CONSTANT uint most_speed_lines = 16U; // per tile

struct MotionBlurConstants {
    uvec2 size_px;
    uvec2 window_min_px; // pixels outside the window are never visible
    uvec2 window_max_px;
    float scale;         // from motion to the displacement in half the exposure
    float most_px;       // upper limit of that displacement
    float line_reach_px; // largest distance of a line's pixel from the edge that it follows
    float cell_px;       // side of a cell of the page that has one speed line
    float line_length;   // length of speed lines, as a multiple of the displacement
    float line_most_px;  // longest speed line
    float line_half_px;  // half width at its start
    float line_from_px;  // least displacement that gets speed lines
    uint seed;
    vec3 line_ink; // linear
};

SHARED_CONSTANT uint smear_block_px = 64U;     // side of the blocks of the page that list their strokes
SHARED_CONSTANT uint most_smear_strokes = 63U; // per block
SHARED_CONSTANT float smear_bow = 0.03F;       // largest sideways bend of a stroke relative to its length

// A position on a triangle, one texel.
struct SmearSeed {
    uint triangle;
    vec2 weight; // barycentric weights of the second and third corner
    uint number; // constant over time and different for each seed
};

// Two texels. A stroke with way_px = 0 is not drawn.
struct SmearStroke {
    vec2 from_px; // the trailing edge of the moving body
    vec2 way_px;  // opposite to the motion, as long as the stroke
    float half_px;
    float depth; // reversed depth of the body
    uint random;
    float least_px; // a pixel that moves farther than this along the body's motion belongs to the body
};

struct SmearConstants {
    mat4 clip_from_anchor_before;
    uvec2 size_px;
    float scale;        // from motion to the displacement in half the exposure
    float most_px;      // upper limit of that displacement
    float length_share; // length of strokes, as a multiple of the displacement
    float spacing_px;   // distance between strokes, across the motion
    float width_px;     // width of the widest stroke
    float from_px;      // least displacement that gets strokes
    uint seed;
    uint count; // number of seeds
    vec3 ink;   // linear
};

#ifdef __cplusplus
static_assert(sizeof(SmearSeed) == 16);
static_assert(sizeof(SmearStroke) == 32);
static_assert(sizeof(SmearConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
