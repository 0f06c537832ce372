// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_RED_BLACK
#define ESTAMPE_FLUID_RED_BLACK

// Gauss-Seidel in a tile: cells of one colour after those of the other, as on a chess board. Is included
// after fluid_tile.glsl.

shared float tile_pressure[fluid_region_cells];

vec4 neighbours_of(int i)
{
    return vec4(tile_pressure[i - 1], tile_pressure[i - fluid_region], tile_pressure[i + 1],
                tile_pressure[i + fluid_region]);
}

void sweep_color(int color)
{
    const int half_row = fluid_region / 2;
    for (int k = int(gl_LocalInvocationIndex); k < half_row * fluid_region; k += fluid_threads) {
        int y = k / half_row;
        int x = 2 * (k % half_row) + ((y + color) & 1);
        int i = y * fluid_region + x;
        if (is_within(x, y)) {
            tile_pressure[i] = relaxed(openings(i), neighbours_of(i), tile_divergence[i]);
        }
    }
    barrier();
}

void sweep_twice()
{
    for (int sweep = 0; sweep < 4; ++sweep) {
        sweep_color(sweep & 1);
    }
}

#endif
