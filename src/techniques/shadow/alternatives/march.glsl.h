// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MARCH_GLSL_H
#define ESTAMPE_MARCH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct MarchConstants {
    uvec2 size;    // size of the height field in texels
    vec2 sunwards; // one step of the ray towards the sun, in texels
    float rise_m;  // rise of the ray towards the sun per step, in metres
    uint step_count;
    uint blur_radius; // radius of the blur in texels
    float blur_falloff;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
