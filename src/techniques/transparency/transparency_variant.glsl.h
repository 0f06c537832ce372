// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRANSPARENCY_VARIANT_GLSL_H
#define ESTAMPE_TRANSPARENCY_VARIANT_GLSL_H
// Bits of `variant` of transparency.comp, in addition to texture_class_mask, the classes of sizes that hold
// textures.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint screen_layers_shift = 5U; // position in `variant` of two bits: number of layers minus 1
SHARED_CONSTANT uint screen_has_tiles = 1U << 7U;

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
