// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MOTION_BLUR_GLSL_H
#define ESTAMPE_MOTION_BLUR_GLSL_H
// What the shaders of motion blur, speed lines and smear strokes share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of the shaders of motion blur.
SHARED_CONSTANT uint blur_has_sky = 1U << 0U; // strokes of the sky stand where nothing is seen
SHARED_CONSTANT uint blur_shows_velocity = 1U << 1U;
SHARED_CONSTANT uint blur_is_stretched = 1U << 2U; // shapes are drawn out along their way
SHARED_CONSTANT uint blur_lays_sky = 1U << 3U;     // strokes of the sky go with the others

SHARED_CONSTANT uint blur_tile_px = 16U;
SHARED_CONSTANT float blur_still_px = 0.25F; // who goes less far to either side of now stands still
SHARED_CONSTANT uint most_speed_lines = 16U; // that pass one tile

struct MotionBlurConstants {
    uvec2 size_px;
    uvec2 window_min_px; // beyond, nothing is seen
    uvec2 window_max_px;
    float scale;         // from motion to the way that is gone in half the time the shutter is open
    float most_px;       // of that
    float line_reach_px; // how far a line lies at most from what it belongs to
    float cell_px;       // of the page, one speed line each
    float line_length;   // by the way in half the time
    float line_most_px;  // and no longer than this
    float line_half_px;  // where it begins
    float line_from_px;  // least way in half the time
    uint seed;
    vec3 line_ink; // linear
};

struct StretchConstants {
    mat4 now_from_before; // from where something stood to where it would be seen alike now
    float share;          // of its way by which a vertex is moved
    uint vertex_count;
};

SHARED_CONSTANT uint smear_block_px = 64U;     // side of the parts of the page that list their strokes
SHARED_CONSTANT uint most_smear_strokes = 63U; // that pass one part
SHARED_CONSTANT float smear_bow = 0.03F;       // how far a stroke bends aside at most, by its length

// A place on a triangle, one texel.
struct SmearSeed {
    uint triangle;
    vec2 weight; // of its second and third corner
    uint number; // steady, and another for each seed
};

// Two texels. Without a way there is no stroke.
struct SmearStroke {
    vec2 from_px; // where what moves ends
    vec2 way_px;  // backwards, as long as the stroke
    float half_px;
    float depth; // reversed, of what it comes from
    uint random;
    float least_px; // that a pixel goes per half the exposure along with what it comes from
};

struct SmearConstants {
    mat4 clip_from_anchor_before;
    uvec2 size_px;
    float scale;        // from motion to the way that is gone in half the time the shutter is open
    float most_px;      // of that
    float length_share; // of strokes, by the same
    float spacing_px;   // from stroke to stroke, across their way
    float width_px;     // of the widest
    float from_px;      // least way in half the time
    uint seed;
    uint count; // of seeds
    vec3 ink;   // linear
};

#ifdef __cplusplus
static_assert(sizeof(StretchConstants) <= 128);
static_assert(sizeof(SmearSeed) == 16);
static_assert(sizeof(SmearStroke) == 32);
static_assert(sizeof(SmearConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
