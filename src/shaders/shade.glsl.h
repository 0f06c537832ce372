// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADE_GLSL_H
#define ESTAMPE_SHADE_GLSL_H
// Alpha of the image of shade colours, which techniques/surface writes and techniques/wash reads. From 0 to 1
// alpha is the share of the lit colour, by the step of the surface's material.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT float shade_absent = -1.0F; // the surface has no shade colour of its own
SHARED_CONSTANT float shade_by_wash = 2.0F; // the wash decides where the surface is in shade

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
