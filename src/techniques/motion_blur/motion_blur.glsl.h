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

// Variant bits: each bit compiles one feature into a motion blur shader.
SHARED_CONSTANT uint blur_has_sky = 1U << 0U; // the sky's strokes are drawn where no surface is visible
SHARED_CONSTANT uint blur_shows_velocity = 1U << 1U;
SHARED_CONSTANT uint blur_is_stretched = 1U << 2U; // shapes are stretched along their motion
SHARED_CONSTANT uint blur_lays_sky = 1U << 3U;     // the sky's strokes are added to the hatching

SHARED_CONSTANT uint blur_tile_px = 16U;
SHARED_CONSTANT float blur_still_px = 0.25F; // a pixel with a smaller displacement counts as standing still
SHARED_CONSTANT uint most_speed_lines = 16U; // largest number of speed lines per tile

struct MotionBlurConstants {
    uvec2 size_px;
    uvec2 window_min_px; // corner of the window, the part of the image that is visible later
    uvec2 window_max_px;
    float scale;         // the motion times `scale` is the displacement in half the exposure
    float most_px;       // upper limit of the displacement in half the exposure
    float line_reach_px; // largest distance of a line's pixel from the edge that the line follows
    float cell_px;       // side of a cell of the page; each cell has at most one speed line
    float line_length;   // length of speed lines, as a multiple of the displacement
    float line_most_px;  // length of the longest speed line
    float line_half_px;  // half the width of a speed line at its start
    float line_from_px;  // smallest displacement at which speed lines are drawn
    uint seed;
    vec3 line_ink; // linear colour of the speed lines
};

// Side in pixels of the blocks of the page; each block has a list of its smear strokes.
SHARED_CONSTANT uint smear_block_px = 64U;
SHARED_CONSTANT uint most_smear_strokes = 63U; // largest number of smear strokes in the list of a block
// Largest sideways bend of a smear stroke, as a share of its length.
SHARED_CONSTANT float smear_bow = 0.03F;

// A position on a triangle at which a smear stroke may start; stored in one texel.
struct SmearSeed {
    uint triangle;
    vec2 weight; // barycentric weights of the triangle's second and third corner
    uint number; // number of the seed: unique, and equal in all frames
};

// A smear stroke; stored in two texels. A stroke with way_px = 0 is not drawn.
struct SmearStroke {
    vec2 from_px; // start of the stroke, on the trailing edge of the moving body
    vec2 way_px;  // vector from the start to the end of the stroke; opposite to the motion
    float half_px;
    float depth; // reversed depth of the body (1 at the near plane)
    uint random;
    float least_px; // least motion, along the body's motion, of a pixel that belongs to the body
};

struct SmearConstants {
    mat4 clip_from_anchor_before;
    uvec2 size_px;
    float scale;        // the motion times `scale` is the displacement in half the exposure
    float most_px;      // upper limit of the displacement in half the exposure
    float length_share; // length of smear strokes, as a multiple of the displacement
    float spacing_px;   // distance between smear strokes, across the motion
    float width_px;     // width of the widest smear stroke
    float from_px;      // smallest displacement at which smear strokes are drawn
    uint seed;
    uint count; // number of seeds
    vec3 ink;   // linear colour of the smear strokes
};

#ifdef __cplusplus
static_assert(sizeof(SmearSeed) == 16);
static_assert(sizeof(SmearStroke) == 32);
static_assert(sizeof(SmearConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
