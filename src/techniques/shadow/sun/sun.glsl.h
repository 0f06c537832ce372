// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_GLSL_H
#define ESTAMPE_SUN_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint sun_levels = 8U;

// The sun's shadow map, as who looks it up needs to know it.
struct SunShadow {
    mat4 clip_from_anchor; // reversed z: 1 nearest to the sun
    vec3 right;            // directions of the map's x and y, both square to the sun
    float texel_m;         // the longer side of a texel; of a clipmap, the finest
    vec3 down;
    float depth_m;     // what clip z of 0 to 1 spans
    vec2 texels_per_m; // along x and y
    uint size;         // texels a side; 0: no shadow
    float sun_slope;   // tangent of the sun's angular radius
    uint level_count;  // of a clipmap; 0 for a single map
    float pixel_m;     // what a pixel spans at a distance of one; in parallel projection at any
    float fade;        // 1: shadow pales towards the edge of the last level
    vec2 window_low[sun_levels];
    vec2 warp; // of a map in perspective: clip y is warp.x - warp.y / w
};

#ifdef __cplusplus
static_assert(sizeof(SunShadow) == 196);
} // namespace estampe::shared
#endif

#endif
