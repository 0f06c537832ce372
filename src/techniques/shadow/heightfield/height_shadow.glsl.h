// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_SHADOW_GLSL_H
#define ESTAMPE_HEIGHT_SHADOW_GLSL_H
#ifdef __cplusplus
#include "shaders/field_sector.glsl.h"
namespace estampe::shared {
#else
#include "shaders/field_sector.glsl.h"
#endif

SHARED_CONSTANT uint height_no_step = 0xffffffffU;

// Fields of one size that are worked out together stand one under another in every image and buffer; the
// third coordinate of a dispatch counts them.
SHARED_CONSTANT uint height_fields_most = 5U;

// Lines that run away from the sun, a texel at a time along one side of the field: step t is a row or column
// of it, counted from the sun's side. At step t every line has moved across by slope * t, so that all of them
// cross it at the same fraction of a texel, and one line more than the field has texels covers it.
struct SweepConstants {
    uvec2 size;         // of a field, texels
    uint steps_along_y; // 1: steps are rows; 0: columns
    uint from_far_end;  // 1: the sun's side is that of the largest coordinate
    int slope;          // texels across for a step, times 65536
    float step_texels;  // along a line
    uint first_step;    // of this dispatch
    uint end_step;
};

struct SunConstants {
    float cos_elevation;
    float sin_elevation;
    float radius_rad;
};

struct ResolveConstants {
    SweepConstants sweep;
    SunConstants sun;
    float texel_m[5]; // of each field
};

// The pyramid of greatest heights in one image. A cell of level 0 lies between four texels; level k stands
// right of level 0, under level k - 1. The next field stands `rows` further down.
struct PyramidConstants {
    uvec2 cells;      // of level 0
    uint level;       // that is made, or the topmost
    uint rows;        // a power of two
    float texel_m[5]; // of each field
    vec2 sunwards;    // unit, in texels
    vec2 slopes;      // least and greatest that make a difference
    SunConstants sun;
    FieldSector wanted; // of what is written in the end
};

struct MarchConstants {
    uvec2 size;    // texels
    vec2 sunwards; // a step, in texels
    float rise_m;  // of the ray over a step
    uint step_count;
    uint blur_radius; // texels
    float blur_falloff;
};

#ifdef __cplusplus
static_assert(sizeof(ResolveConstants) == 64);
static_assert(sizeof(PyramidConstants) == 120);
} // namespace estampe::shared
#endif

#endif
