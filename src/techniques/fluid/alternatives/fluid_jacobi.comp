// SPDX-License-Identifier: MIT
// One workgroup per tile: a few rounds of Jacobi's iteration.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;
layout(binding = 2) uniform samplerBuffer pressure;

layout(scalar, binding = 3) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidTile tile;
};

#include "techniques/fluid/pressure/fluid_tile.glsl"

shared float tile_pressures[2 * fluid_region_cells]; // double buffer: pressures before and after an iteration

void iterate(int from, int to)
{
    for (int i = int(gl_LocalInvocationIndex); i < fluid_region_cells; i += fluid_threads) {
        if (is_within(i % fluid_region, i / fluid_region)) {
            int last = from + i;
            vec4 neighbours = vec4(tile_pressures[last - 1], tile_pressures[last - fluid_region],
                                   tile_pressures[last + 1], tile_pressures[last + fluid_region]);
            tile_pressures[to + i] = relaxed(openings(i), neighbours, tile_divergence[i]);
        }
    }
    barrier();
}

void main()
{
    for (int i = int(gl_LocalInvocationIndex); i < fluid_region_cells; i += fluid_threads) {
        ivec2 cell = cell_of_slot(i);
        load_equation(i, cell);
        tile_pressures[i] = cell.x < 0 ? 0.0 : texelFetch(pressure, index_in_level(cell)).x;
        tile_pressures[fluid_region_cells + i] = 0.0;
    }
    barrier();
    int from = 0;
    for (int round = 0; round < int(tile.rounds); ++round) {
        iterate(from, fluid_region_cells - from);
        from = fluid_region_cells - from;
    }
    for (int k = int(gl_LocalInvocationIndex); k < int(fluid_tile * fluid_tile); k += fluid_threads) {
        ivec2 in_tile = ivec2(k % int(fluid_tile), k / int(fluid_tile));
        ivec2 cell = tile_origin() + in_tile;
        if (all(lessThan(cell, level_size()))) {
            int i = (in_tile.y + int(fluid_halo)) * fluid_region + in_tile.x + int(fluid_halo);
            out_pressure[index_in_level(cell)] = tile_pressures[from + i];
        }
    }
}
