// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STIPPLE_GLSL_H
#define ESTAMPE_STIPPLE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct StippleConstants {
    uvec2 size_px;
    float cell_px; // side of the square cell that each dot has
    float jitter;  // largest offset of a dot from its cell's middle, in cells
    uint seed;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
