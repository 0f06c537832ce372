// SPDX-License-Identifier: MIT
// One thread per cell: accelerates the fluid from cells with more mass towards cells with less mass.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform usamplerBuffer mass;
layout(binding = 2) uniform usamplerBuffer solids;
layout(binding = 3, r32f) writeonly uniform image2DArray out_velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidMass moved;
};

#include "techniques/fluid/fluid_fields.glsl"

bool is_solid(uint index)
{
    return (variant & fluid_bit_solids) != 0u && texelFetch(solids, int(index)).x != 0u;
}

// Outflow of a cell in metres per second.
float outflow(ivec3 cell)
{
    float sum = 0.0;
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        int layer = axis * int(grid.depth);
        bool is_last = cell[axis] + 1 == fluid_size()[axis];
        ivec3 after = neighbour(cell, axis, 1);
        float at_end =
            is_last && !is_periodic(axis) ? 0.0 : texelFetch(velocity, ivec3(after.xy, layer + after.z), 0).x;
        sum += at_end - texelFetch(velocity, ivec3(cell.xy, layer + cell.z), 0).x;
    }
    return sum;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    uint here = fluid_cell_index(cell);
    uint mass_here = texelFetch(mass, int(here)).x;
    float outflow_here = moved.damping > 0.0 ? outflow(cell) : 0.0;
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        ivec3 before = cell;
        before[axis] = cell[axis] == 0 ? fluid_size()[axis] - 1 : cell[axis] - 1;
        uint there = fluid_cell_index(before);
        uint mass_there = texelFetch(mass, int(there)).x;
        ivec3 texel = ivec3(cell.xy, axis * int(grid.depth) + cell.z);
        float speed = texelFetch(velocity, texel, 0).x;
        if (!is_solid(here) && !is_solid(there)) {
            speed -= moved.gain_per_unit * (float(mass_here) - float(mass_there));
            if (moved.damping > 0.0) {
                speed += moved.damping * (outflow_here - outflow(before));
            }
        }
        imageStore(out_velocity, texel, vec4(is_on_wall(axis, cell) ? 0.0 : speed));
    }
}
