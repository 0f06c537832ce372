// SPDX-License-Identifier: MIT
// One workgroup per tile of a multigrid level: adds the next coarser level's pressure, and does two smoothing
// sweeps.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;
layout(binding = 2) uniform samplerBuffer pressure;
layout(binding = 3) uniform samplerBuffer coarse_pressure;

layout(scalar, binding = 4) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidTile tile;
};

#include "techniques/fluid/pressure/fluid_tile.glsl"

float corrected(ivec2 cell)
{
    if (cell.x < 0) {
        return 0.0;
    }
    ivec2 coarse = cell / 2;
    return texelFetch(pressure, index_in_level(cell)).x +
           texelFetch(coarse_pressure, coarse.y * int(tile.coarse.width) + coarse.x).x;
}

void main()
{
    for (int i = int(gl_LocalInvocationIndex); i < fluid_region_cells; i += fluid_threads) {
        ivec2 cell = cell_of_slot(i);
        load_equation(i, cell);
        tile_pressure[i] = corrected(cell);
    }
    barrier();
    sweep_twice();
    for (int k = int(gl_LocalInvocationIndex); k < int(fluid_tile * fluid_tile); k += fluid_threads) {
        ivec2 in_tile = ivec2(k % int(fluid_tile), k / int(fluid_tile));
        ivec2 cell = tile_origin() + in_tile;
        if (all(lessThan(cell, level_size()))) {
            out_pressure[index_in_level(cell)] =
                tile_pressure[(in_tile.y + int(fluid_halo)) * fluid_region + in_tile.x + int(fluid_halo)];
        }
    }
}
