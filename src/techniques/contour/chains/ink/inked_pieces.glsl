// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INKED_PIECES
#define ESTAMPE_INKED_PIECES

// Functions shared by all shaders that ink lines from sample to sample. Requires before inclusion:
// ink_tiles.glsl, and `constants` with the page's width.

const float widest_px = 96.0; // largest half width of a line, in pixels

// A line thinner than a pixel is drawn one pixel wide and lighter.
float coverage(float half_width, float distance)
{
    return clamp(max(half_width, 0.5) + 0.5 - distance, 0.0, 1.0) * min(half_width / 0.5, 1.0);
}

// Adds the tiles that a rectangle of pixels covers to the list of tiles.
void list_tiles(ivec2 low, ivec2 high)
{
    uint columns = (constants.width + 7u) / 8u;
    if (any(greaterThanEqual(low, high))) {
        return;
    }
    for (int y = low.y / 8; y <= (high.y - 1) / 8; ++y) {
        for (int x = low.x / 8; x <= (high.x - 1) / 8; ++x) {
            uint tile = uint(y) * columns + uint(x);
            if (atomicExchange(ink_tiles[tile].is_listed, 1u) == 0u) {
                ink_tiles[atomicAdd(tile_count, 1u)].tile = tile;
            }
        }
    }
}

#endif
