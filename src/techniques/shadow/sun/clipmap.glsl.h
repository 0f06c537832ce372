// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLIPMAP_GLSL_H
#define ESTAMPE_CLIPMAP_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// A square of a level, both of powers of two, and where a picture of it begins. Its first column is a
// multiple of 4.
struct MixedSquare {
    uvec2 low;  // as two's complement
    uint sizes; // logarithms: of the square's side in bits 0-7, of the level's in 8-15; the level above
    uint first_texel;
};

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
