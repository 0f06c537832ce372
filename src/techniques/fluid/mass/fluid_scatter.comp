// SPDX-License-Identifier: MIT
// One thread per cell: moves the unclaimed mass along the flow, and distributes that mass over the cells
// around the destination.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform usamplerBuffer mass;
layout(binding = 2) uniform usamplerBuffer taken;

layout(scalar, binding = 3) buffer Next
{
    uint next_mass[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidMass moved;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/mass/fluid_shares.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    uint index[fluid_most_sharers];
    uint weight[fluid_most_sharers];
    share_out(cell, way_from_middle(velocity, cell, moved.cells_per_speed), index, weight);
    for (uint channel = 0u; channel < moved.channels; ++channel) {
        int here = int(mass_index(fluid_cell_index(cell), channel));
        uint left = texelFetch(mass, here).x - texelFetch(taken, here).x;
        uint rest = left;
        for (int i = 0; i < sharer_count() && rest != 0u; ++i) {
            uint part = i == sharer_count() - 1 ? rest : part_of(left, 2u * weight[i]);
            rest -= part;
            if (part != 0u) {
                atomicAdd(next_mass[mass_index(index[i], channel)], part);
            }
        }
    }
}
