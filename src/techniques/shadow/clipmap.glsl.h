// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLIPMAP_GLSL_H
#define ESTAMPE_CLIPMAP_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct SunVerticesConstants {
    vec3 right; // times texels a metre
    uint vertex_count;
    vec3 down;
    vec4 depth_row; // of the sun's clip z
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
