// SPDX-License-Identifier: MIT
// One thread per cell: claims mass for the cell from the cells around the point from which the flow comes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;

layout(scalar, binding = 1) buffer Claims
{
    uint claims[];
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
        atomicAdd(claims[index[i]], weight[i]);
    }
}
