// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRANSPARENCY_VARIANT_GLSL_H
#define ESTAMPE_TRANSPARENCY_VARIANT_GLSL_H
// What is asked of transparency.comp besides the size classes that hold textures, texture_class_mask.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint screen_layers_shift = 5U; // how many there are besides the first, two bits
SHARED_CONSTANT uint screen_has_tiles = 1U << 7U;

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
