// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STIPPLE_GLSL_H
#define ESTAMPE_STIPPLE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct StippleConstants {
    uvec2 size_px;
    float cell_px; // a dot has a square cell
    float jitter;  // how far from its middle a dot may be, in cells
    uint seed;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
