// SPDX-License-Identifier: MIT
// One thread per cell: takes the mass that the cell has claimed from its surroundings. If more mass was
// claimed than exists, claims are scaled down.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform usamplerBuffer mass;
layout(binding = 2) uniform usamplerBuffer claims;

layout(scalar, binding = 3) buffer Taken
{
    uint taken[];
};

layout(scalar, binding = 4) writeonly buffer Next
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
    share_out(cell, way_from_middle(velocity, cell, -moved.cells_per_speed), index, weight);
    for (int i = 0; i < sharer_count(); ++i) {
        uint all_claims = max(texelFetch(claims, int(index[i])).x, fluid_mass_whole);
        weight[i] = (weight[i] << 16u) / all_claims;
    }
    for (uint channel = 0u; channel < moved.channels; ++channel) {
        uint sum = 0u;
        for (int i = 0; i < sharer_count(); ++i) {
            uint from = mass_index(index[i], channel);
            uint part = part_of(texelFetch(mass, int(from)).x, weight[i]);
            sum += part;
            atomicAdd(taken[from], part);
        }
        next_mass[mass_index(fluid_cell_index(cell), channel)] = sum;
    }
}
