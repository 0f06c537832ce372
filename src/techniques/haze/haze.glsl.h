// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HAZE_GLSL_H
#define ESTAMPE_HAZE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint haze_has_tiles = 1U << 0U; // bit of `variant` of haze.comp: fade only the listed tiles

struct HazeConstants {
    float start_m;      // distance up to which there is no haze
    float halves_per_m; // halvings of contrast per metre, beyond start_m
    float ink;          // factor by which strokes and lines fade faster than colour
    uint line_reach_px; // largest distance in pixels of a line's pixel from the edge that the line follows
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
