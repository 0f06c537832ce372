// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TILES
#define ESTAMPE_TILES

// Tiles of the page that share how far a blur looks, and those about them.

// Pixel `i` of a tile of `side` pixels, in rows.
ivec2 pixel_of_tile(ivec2 tile, int side, int i)
{
    return side * tile + ivec2(i % side, i / side);
}

// One of the tiles about a tile.
struct TileAbout {
    ivec2 tile;
    ivec2 away;    // tiles, along each axis
    ivec2 between; // whole tiles that lie between the two
};

// How many tiles to each side something reaches that goes so far.
int tiles_to_each_side(float reach_px, uint tile_px)
{
    return int(ceil(max(reach_px, 1.0) / float(tile_px)));
}

// Tile `i` of the square about `tile`, of those that there are.
TileAbout tile_about(ivec2 tile, int reach, int i, ivec2 count)
{
    int side = 2 * reach + 1;
    ivec2 aside = ivec2(i % side, i / side) - reach;
    return TileAbout(clamp(tile + aside, ivec2(0), count - 1), abs(aside), max(abs(aside) - 1, ivec2(0)));
}

#endif
