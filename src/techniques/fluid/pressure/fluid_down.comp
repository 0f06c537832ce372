// SPDX-License-Identifier: MIT
// One workgroup per tile of a multigrid level: makes two smoothing sweeps from zero pressure, then sums the
// residual over each cell of the next coarser level.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;

layout(scalar, binding = 2) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(scalar, binding = 3) writeonly buffer Coarse
{
    float out_coarse_divergence[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidTile tile;
};

#include "techniques/fluid/pressure/fluid_tile.glsl"

// Residual of the pressure equation at slot `i` of the tile.
float residual(int i)
{
    vec4 open = openings(i);
    return tile_divergence[i] - dot(open, neighbours_of(i) - tile_pressure[i]);
}

void main()
{
    for (int i = int(gl_LocalInvocationIndex); i < fluid_region_cells; i += fluid_threads) {
        load_equation(i, cell_of_slot(i));
        tile_pressure[i] = 0.0;
    }
    barrier();
    sweep_twice();
    ivec2 coarse = ivec2(gl_LocalInvocationID.xy);
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        ivec2 in_tile = 2 * coarse + ivec2(k & 1, k >> 1);
        int i = (in_tile.y + int(fluid_halo)) * fluid_region + in_tile.x + int(fluid_halo);
        sum += residual(i);
        ivec2 cell = tile_origin() + in_tile;
        if (all(lessThan(cell, level_size()))) {
            out_pressure[index_in_level(cell)] = tile_pressure[i];
        }
    }
    ivec2 coarse_cell = tile_origin() / 2 + coarse;
    if (all(lessThan(coarse_cell, ivec2(tile.coarse.width, tile.coarse.height)))) {
        out_coarse_divergence[coarse_cell.y * int(tile.coarse.width) + coarse_cell.x] = sum;
    }
}
