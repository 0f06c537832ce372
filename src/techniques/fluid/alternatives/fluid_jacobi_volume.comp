// SPDX-License-Identifier: MIT
// One thread per cell of a 3D fluid: one round of Jacobi's iteration.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer solids;
layout(binding = 2) uniform samplerBuffer pressure;

layout(scalar, binding = 3) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"

// If the face between a cell and its neighbour is open, adds the neighbour's pressure to sum.x and 1 to
// sum.y.
void add_neighbour(ivec3 cell, int axis, int step, inout vec2 sum)
{
    int size = fluid_size()[axis];
    int place = cell[axis] + step;
    if (!is_periodic(axis) && (place < 0 || place >= size)) {
        return;
    }
    cell[axis] = (place + size) % size;
    int index = int(fluid_cell_index(cell));
    if ((variant & fluid_bit_solids) == 0u || texelFetch(solids, index).x == 0u) {
        sum += vec2(texelFetch(pressure, index).x, 1.0);
    }
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec2 sum = vec2(0.0);
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        add_neighbour(cell, axis, -1, sum);
        add_neighbour(cell, axis, 1, sum);
    }
    uint index = fluid_cell_index(cell);
    out_pressure[index] = sum.y > 0.0 ? (sum.x - texelFetch(divergence, int(index)).x) / sum.y : 0.0;
}
