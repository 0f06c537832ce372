// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOCAL_GLSL_H
#define ESTAMPE_LOCAL_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// The shadow maps of one local light: one map along a spot's beam, or six along the axes of anchor space,
// +x -x +y -y +z -z, one after another. Texels hold near_m / w, w being the distance along the map's axis.
struct LocalShadow {
    vec3 right;       // of a spot's map, towards its growing columns
    float scale;      // half the map's side, at distance 1 from the light, is 1 / scale
    vec3 down;        // of a spot's map, towards its growing rows
    uint first_texel; // in the buffer of all maps
    vec3 along;       // the axis of a spot's map
    uint size;        // texels a side
    float near_m;
    uint is_cube;
    float radius_m; // of the ball that glows; 0: a point
    uint unused;    // four texels of four words
};

#ifdef __cplusplus
static_assert(sizeof(LocalShadow) == 64);
} // namespace estampe::shared
#endif

#endif
