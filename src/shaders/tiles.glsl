// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILES
#define ESTAMPE_TILES

// Divides the page into tiles, whose pixels all use one blur radius, and finds the neighbours of a tile.

// Page position of pixel number `i`, counted row by row, in a tile of `side` x `side` pixels.
ivec2 pixel_of_tile(ivec2 tile, int side, int i)
{
    return side * tile + ivec2(i % side, i / side);
}

// A tile in the neighbourhood of another tile.
struct TileAbout {
    ivec2 tile;
    ivec2 away;    // distance from the middle tile of the neighbourhood, in tiles, along each axis
    ivec2 between; // number of tiles between the two tiles, along each axis
};

// Number of tiles to each side that a blur radius reaches.
int tiles_to_each_side(float reach_px, uint tile_px)
{
    return int(ceil(max(reach_px, 1.0) / float(tile_px)));
}

// The `i`-th tile of the square neighbourhood around `tile`, clamped to the page.
TileAbout tile_about(ivec2 tile, int reach, int i, ivec2 count)
{
    int side = 2 * reach + 1;
    ivec2 aside = ivec2(i % side, i / side) - reach;
    return TileAbout(clamp(tile + aside, ivec2(0), count - 1), abs(aside), max(abs(aside) - 1, ivec2(0)));
}

#endif
