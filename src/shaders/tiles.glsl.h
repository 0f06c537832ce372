// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILES_GLSL_H
#define ESTAMPE_TILES_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// A list of tiles of 8 x 8 pixels that one pass finds and others work on, a group each: the arguments of
// their dispatches, how many there are, then the tiles, columns in the lower half of a word and rows in the
// upper. gpu::add_empty_tile_list() makes an empty one.

SHARED_CONSTANT uint tile_list_count = 3U;   // the word that holds it, after three of arguments
SHARED_CONSTANT uint tile_list_first = 4U;   // and the first tile's
SHARED_CONSTANT uint tile_list_groups = 64U; // in a row of the dispatch; lists may be longer than a row

// Tiles of pictures that are squares, a word each: which picture from bit 16 on, the tile's row in bits 8-15,
// its column in 0-7.

SHARED_CONSTANT uint square_tile_texels = 64U; // a side

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
