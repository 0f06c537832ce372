// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILES_GLSL_H
#define ESTAMPE_TILES_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// A list of tiles of 8 x 8 pixels that one pass fills and other passes process, one workgroup per tile. The
// list holds the dispatch arguments, the number of tiles, and the tiles, with columns in the lower half of a
// word and rows in the upper half. gpu::add_empty_tile_list() creates an empty list.

// Index of the word that holds the number of tiles; the three dispatch arguments come before it.
SHARED_CONSTANT uint tile_list_count = 3U;
SHARED_CONSTANT uint tile_list_first = 4U; // index of the word that holds the first tile
// Number of workgroups in a row of the dispatch; lists may be longer than a row.
SHARED_CONSTANT uint tile_list_groups = 64U;

// A list of tiles of square images, with one 32-bit word per tile: the image's number from bit 16 on, the
// tile's row in bits 8-15, the tile's column in bits 0-7.

SHARED_CONSTANT uint square_tile_texels = 64U; // texels per side of a tile of square images

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
