// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HAZE_GLSL_H
#define ESTAMPE_HAZE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint haze_has_tiles = 1U << 0U; // variant bit of haze.comp: fade only listed tiles

struct HazeConstants {
    float start_m;      // no haze up to this distance
    float halves_per_m; // beyond start_m: half-lives per metre
    float ink;          // how much faster strokes and lines fade than colour
    uint line_reach_px; // largest distance of a line's pixel from the edge it follows
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
