// SPDX-License-Identifier: MIT
// One thread per cell: the outflow of the cell. Nothing flows out of obstacles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform usamplerBuffer solids;

layout(scalar, binding = 2) writeonly buffer Divergence
{
    float out_divergence[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"

// Outflow of a cell: divergence of the velocity times the cell size.
float outflow_of(sampler2DArray velocity, ivec3 cell)
{
    int depth = int(grid.depth);
    float sum = 0.0;
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        ivec3 next = cell;
        ++next[axis];
        bool is_last = next[axis] == fluid_size()[axis];
        next[axis] = is_last ? 0 : next[axis];
        float in_low = texelFetch(velocity, ivec3(cell.xy, axis * depth + cell.z), 0).x;
        float out_high = texelFetch(velocity, ivec3(next.xy, axis * depth + next.z), 0).x;
        sum += (is_last && !is_periodic(axis) ? 0.0 : out_high) -
               (cell[axis] == 0 && !is_periodic(axis) ? 0.0 : in_low);
    }
    return sum;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    uint index = fluid_cell_index(cell);
    bool is_solid = (variant & fluid_bit_solids) != 0u && texelFetch(solids, int(index)).x != 0u;
    out_divergence[index] = is_solid ? 0.0 : outflow_of(velocity, cell);
}
