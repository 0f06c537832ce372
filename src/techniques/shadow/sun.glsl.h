// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_GLSL_H
#define ESTAMPE_SUN_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// The sun's shadow map, as who looks it up needs to know it.
struct SunShadow {
    mat4 clip_from_anchor; // reversed z: 1 nearest to the sun
    float texel_m;         // the longer side of a texel
    float depth_m;         // what clip z of 0 to 1 spans
    uint size;             // texels a side; 0: no shadow
};

#ifdef __cplusplus
static_assert(sizeof(SunShadow) == 76);
} // namespace estampe::shared
#endif

#endif
