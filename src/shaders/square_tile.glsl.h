// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SQUARE_TILE_GLSL_H
#define ESTAMPE_SQUARE_TILE_GLSL_H
// Tiles of pictures that are squares, a word each: which picture from bit 16 on, the tile's row in bits 8-15,
// its column in 0-7.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint square_tile_texels = 64U; // a side

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
