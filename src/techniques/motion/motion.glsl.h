// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MOTION_GLSL_H
#define ESTAMPE_MOTION_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// The current and the previous camera, without the subpixel shift of the antialiasing sample.
struct MotionConstants {
    mat4 clip_from_anchor;
    mat4 clip_from_anchor_before;
};

#ifdef __cplusplus
static_assert(sizeof(MotionConstants) == 128);
} // namespace estampe::shared
#endif

#endif
