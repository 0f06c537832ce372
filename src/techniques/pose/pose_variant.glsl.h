// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_POSE_VARIANT_GLSL_H
#define ESTAMPE_POSE_VARIANT_GLSL_H
// What is asked of pose.comp.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint pose_has_skins = 1U << 0U;
SHARED_CONSTANT uint pose_has_morphs = 1U << 1U;

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
