// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_AFTERGLOW_GLSL_H
#define ESTAMPE_AFTERGLOW_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct AfterglowConstants {
    uvec2 size_px;
    float kept; // share of the previous ink that remains; 0 without a previous picture
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
