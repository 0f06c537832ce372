// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMEAR_GLSL_H
#define ESTAMPE_SMEAR_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

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
static_assert(sizeof(SmearSeed) == 16);
static_assert(sizeof(SmearStroke) == 32);
static_assert(sizeof(SmearConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
