// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MARCH_GLSL_H
#define ESTAMPE_MARCH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct MarchConstants {
    uvec2 size;    // size of each height field in texels; all fields are stacked vertically in one image
    vec2 sunwards; // one step of the ray towards the sun, in texels
    float rise;    // rise of the ray towards the sun, as height per level distance
    uint step_count;
    uint field_count;
    float texel_m[5];     // distance between two texels of each height field
    float blur_texels[5]; // standard deviation of the blur of each field; 0 does not blur
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
