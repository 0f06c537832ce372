// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STRETCH_GLSL_H
#define ESTAMPE_STRETCH_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct StretchConstants {
    // Transforms positions of the previous frame, so that the current camera sees them at the place where the
    // previous camera saw them.
    mat4 now_from_before;
    float share; // share of its motion by which a vertex is displaced
    uint vertex_count;
};

#ifdef __cplusplus
static_assert(sizeof(StretchConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
