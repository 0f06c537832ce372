// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_NEIGHBORS_GLSL_H
#define ESTAMPE_NEIGHBORS_GLSL_H
// What an edge mesh says of a triangle: the three sides that face its own, or no_side; then flags.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_side = 0xffffffffU;

// The triangle runs against the sense of its shell, which is that of most normals; which of its sides are
// smooth, where shading goes on; the normals of the smooth piece it is of point to the back, in the sense of
// the shell; and from this bit on the number of its shell, from 1, or 0 where it has no lines.
SHARED_CONSTANT uint neighbor_is_turned = 1U;
SHARED_CONSTANT uint neighbor_smooth_shift = 1U;
SHARED_CONSTANT uint neighbor_is_inside_out = 16U;
SHARED_CONSTANT uint neighbor_shell_shift = 5U;

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
