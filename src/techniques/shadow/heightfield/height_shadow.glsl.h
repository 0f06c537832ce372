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

// Most height fields that are computed together. All fields have equal size and are stacked vertically in
// every image and buffer. The third coordinate of a dispatch selects the field.
SHARED_CONSTANT uint height_fields_most = 5U;

// Constants of a sweep along lines that run away from the sun, one texel per step along one side of the
// field. A step is one row or one column; steps are counted from the sun's side. In each step all lines move
// sideways by one common distance. So all lines cross a row at one common fraction of a texel. The number of
// lines across a step is the field's number of texels plus one.
struct SweepConstants {
    uvec2 size;         // size of a field in texels
    uint steps_along_y; // 1: steps of the sweep are rows; 0: steps are columns
    uint from_far_end;  // 1: the sweep starts at the largest coordinate, because the sun is on that side
    int slope;          // texels that a line moves sideways per step, times 65536
    float step_texels;  // length of a step along a line, in texels
    uint first_step;
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
    float texel_m[5]; // texel size of each height field
};

// Pyramid of maximum heights in one image. A cell of level 0 covers the square between four texels. Level 1
// is to the right of level 0, and each further level is below the level before. The pyramid of the next
// height field starts `rows` further down.
struct PyramidConstants {
    uvec2 cells;      // number of pyramid cells of level 0
    uint level;       // pyramid level to compute, or the topmost level
    uint rows;        // rows of the image per field, a power of two
    float texel_m[5]; // texel size of each height field
    vec2 sunwards;    // direction towards the sun, a unit vector in texels
    vec2 slopes;      // lowest and highest horizon slope that affect the result
    SunConstants sun;
    FieldSector wanted; // texels whose result is needed
};

#ifdef __cplusplus
static_assert(sizeof(ResolveConstants) == 64);
static_assert(sizeof(PyramidConstants) == 120);
} // namespace estampe::shared
#endif

#endif
