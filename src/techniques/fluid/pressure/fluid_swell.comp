// SPDX-License-Identifier: MIT
// One thread per cell: subtracts the outflow by which the fluid expands from the measured outflow, so that a
// projection removes the rest. Or adds the mass of the expansion to a cell's mass.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer wanted;
layout(binding = 1) uniform samplerBuffer share; // what a cell of weight 1 lets out
layout(binding = 2) uniform usamplerBuffer solids;

layout(binding = 3) uniform usamplerBuffer numbers; // bits of floats, or units of mass with fluid_bit_massive

layout(scalar, binding = 4) writeonly buffer Numbers
{
    uint out_numbers[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidExpansion expansion;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/pressure/fluid_vent.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    uint index = fluid_cell_index(cell);
    float more =
        texelFetch(wanted, int(index)).x - texelFetch(share, 0).x * vent_weight(cell, expansion.rim_cells);
    uint number = texelFetch(numbers, int(index)).x;
    if ((variant & fluid_bit_massive) != 0u) {
        out_numbers[index] = uint(max(int(number) + int(round(more * float(fluid_mass_unit))), 0));
    } else {
        out_numbers[index] = floatBitsToUint(uintBitsToFloat(number) - more);
    }
}
