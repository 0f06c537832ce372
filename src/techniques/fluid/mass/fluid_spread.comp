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

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    uint here = fluid_cell_index(cell);
    uint mass_here = texelFetch(mass, int(here)).x;
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        ivec3 before = cell;
        before[axis] = cell[axis] == 0 ? fluid_size()[axis] - 1 : cell[axis] - 1;
        uint there = fluid_cell_index(before);
        uint mass_there = texelFetch(mass, int(there)).x;
        ivec3 texel = ivec3(cell.xy, axis * int(grid.depth) + cell.z);
        float speed = texelFetch(velocity, texel, 0).x;
        if (!is_solid(here) && !is_solid(there)) {
            speed -= moved.gain_per_unit * (float(mass_here) - float(mass_there));
        }
        imageStore(out_velocity, texel, vec4(is_on_wall(axis, cell) ? 0.0 : speed));
    }
}
