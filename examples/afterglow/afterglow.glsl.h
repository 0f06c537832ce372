// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_AFTERGLOW_GLSL_H
#define ESTAMPE_AFTERGLOW_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct AfterglowConstants {
    uvec2 size_px;
    float kept; // share of the ink before that is still there; 0 where there is none
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
