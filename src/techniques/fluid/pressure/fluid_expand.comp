// SPDX-License-Identifier: MIT
// One thread per cell: the outflow by which a cell of hot fluid expands, or the mass that it gains. Each
// workgroup also sums these numbers over its cells, and the weights of the cells that let fluid out.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray quantities;
layout(binding = 1) uniform usamplerBuffer solids;
layout(binding = 2) uniform usamplerBuffer mass; // only with fluid_bit_massive

layout(scalar, binding = 3) writeonly buffer Wanted
{
    float out_wanted[];
};

// Sum of `out_wanted`, then sum of the weights, for each workgroup.
layout(scalar, binding = 4) writeonly buffer Parts
{
    vec2 out_parts[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidExpansion expansion;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/pressure/fluid_growth.glsl"
#include "techniques/fluid/pressure/fluid_vent.glsl"

const uint threads = 64u;
shared vec2 sums[threads];

// The mass that a cell of hot fluid gains in a step, or the cell's outflow. The mass m at the temperature T
// would have the temperature T / m, once it has expanded to the mass 1.
float wanted_of(ivec3 cell)
{
    float temperature =
        texelFetch(quantities, ivec3(cell.xy, fluid_temperature * int(grid.depth) + cell.z), 0).x;
    if ((variant & fluid_bit_massive) == 0u) {
        return expansion.speed_per_log *
               log(growth_at(temperature, expansion.expands_above, expansion.excess_kept));
    }
    float held = float(texelFetch(mass, int(fluid_cell_index(cell))).x) / float(fluid_mass_unit);
    float expanded = temperature / max(held, 1.0 / float(fluid_mass_unit));
    return held * (growth_at(expanded, expansion.expands_above, expansion.excess_kept) - 1.0);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    vec2 own = vec2(0.0);
    if (is_in_grid(cell)) {
        uint index = fluid_cell_index(cell);
        bool is_solid = (variant & fluid_bit_solids) != 0u && texelFetch(solids, int(index)).x != 0u;
        own = vec2(is_solid ? 0.0 : wanted_of(cell), vent_weight(cell, expansion.rim_cells));
        out_wanted[index] = own.x;
    }
    uint thread = gl_LocalInvocationIndex;
    sums[thread] = own;
    for (uint stride = threads / 2u; stride > 0u; stride /= 2u) {
        barrier();
        if (thread < stride) {
            sums[thread] += sums[thread + stride];
        }
    }
    if (thread == 0u) {
        uvec3 group = gl_WorkGroupID;
        out_parts[(group.z * gl_NumWorkGroups.y + group.y) * gl_NumWorkGroups.x + group.x] = sums[0];
    }
}
