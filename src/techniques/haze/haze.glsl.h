// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HAZE_GLSL_H
#define ESTAMPE_HAZE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint haze_has_tiles = 1U << 0U; // variant bit of haze.comp: only those of a list are faded

struct HazeConstants {
    float start_m;      // nearer all is clear
    float halves_per_m; // beyond: how often half of what is left goes
    float ink;          // how much sooner strokes and lines go
    uint line_reach_px; // how far a line lies at most from what it belongs to
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
