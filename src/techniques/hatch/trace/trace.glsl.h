// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRACE_GLSL_H
#define ESTAMPE_TRACE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// Where the middle of a line of strokes passes between the centres of two neighbouring pixels.
struct Crossing {
    uint edge;            // 2 * pixel, row by row, + 1 where the other pixel is below it and not beside it
    uint draw;            // draw + 1
    uint line;            // family; exponent + 128 from bit 8: the line is where v = number * 2^exponent
    int number;           // odd, or 0
    uint place_and_width; // from pixel to pixel, 0 to 65535; width in pixels, a half, above
};

#ifdef __cplusplus
static_assert(sizeof(Crossing) == 20);
} // namespace estampe::shared
#endif

#endif
