// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MARCH_GLSL_H
#define ESTAMPE_MARCH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct MarchConstants {
    uvec2 size;    // in texels
    vec2 sunwards; // one step, in texels
    float rise_m;  // rise of the ray per step
    uint step_count;
    uint blur_radius; // in texels
    float blur_falloff;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
