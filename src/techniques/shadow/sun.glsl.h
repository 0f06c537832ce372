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
    vec3 right;            // directions of the map's x and y, both square to the sun
    float texel_m;         // the longer side of a texel
    vec3 down;
    float depth_m;     // what clip z of 0 to 1 spans
    vec2 texels_per_m; // along x and y
    uint size;         // texels a side; 0: no shadow
    float sun_slope;   // tangent of the sun's angular radius
};

#ifdef __cplusplus
static_assert(sizeof(SunShadow) == 112);
} // namespace estampe::shared
#endif

#endif
