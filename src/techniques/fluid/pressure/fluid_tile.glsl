// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_TILE
#define ESTAMPE_FLUID_TILE

// A tile of a multigrid level in shared memory, with a halo that shrinks by a cell with each sweep. Requires
// `variant`, `tile`, a FluidTile, and texel buffers `divergence` and `weights`. The equation of a cell: sum
// over the neighbours of (pressure difference to the cell times opening of the face between) = divergence of
// the cell.

const int fluid_region = int(fluid_tile + 2u * fluid_halo);
const int fluid_region_cells = fluid_region * fluid_region;
const int fluid_threads = 256;

shared float tile_divergence[fluid_region_cells];
shared uint tile_weights[fluid_region_cells];

bool wraps(int axis)
{
    return (variant & (fluid_bit_periodic << axis)) != 0u;
}

ivec2 level_size()
{
    return ivec2(tile.level.width, tile.level.height);
}

ivec2 tile_origin()
{
    return ivec2(gl_WorkGroupID.xy) * int(fluid_tile);
}

// Cell of the multigrid level for slot `i` of the tile's region; x is negative if the slot has no cell.
ivec2 cell_of_slot(int i)
{
    ivec2 size = level_size();
    ivec2 cell = tile_origin() - int(fluid_halo) + ivec2(i % fluid_region, i / fluid_region);
    ivec2 wrapped = ivec2(wraps(0) ? (cell.x + size.x * int(fluid_halo)) % size.x : cell.x,
                          wraps(1) ? (cell.y + size.y * int(fluid_halo)) % size.y : cell.y);
    bool is_there = all(greaterThanEqual(wrapped, ivec2(0))) && all(lessThan(wrapped, size));
    return is_there ? wrapped : ivec2(-1);
}

int index_in_level(ivec2 cell)
{
    return cell.y * int(tile.level.width) + cell.x;
}

void load_equation(int i, ivec2 cell)
{
    bool is_there = cell.x >= 0;
    tile_divergence[i] = is_there ? texelFetch(divergence, index_in_level(cell)).x : 0.0;
    tile_weights[i] = is_there ? texelFetch(weights, int(tile.level.first) + index_in_level(cell)).x : 0u;
}

// Openings of the faces of the cell in slot `i`: towards lower x, lower y, higher x, higher y.
vec4 openings(int i)
{
    return vec4(unpackHalf2x16(tile_weights[i]), unpackHalf2x16(tile_weights[i + 1]).x,
                unpackHalf2x16(tile_weights[i + fluid_region]).y);
}

// Whether all four neighbours of a slot are in the tile's region.
bool is_within(int x, int y)
{
    return x > 0 && y > 0 && x < fluid_region - 1 && y < fluid_region - 1;
}

float relaxed(vec4 open, vec4 neighbours, float own_divergence)
{
    float all_open = dot(open, vec4(1.0));
    return all_open > 0.0 ? (dot(open, neighbours) - own_divergence) / all_open : 0.0;
}

// Red-black Gauss-Seidel in a tile: updates all cells of one chess board colour, then all cells of the other
// colour.

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
