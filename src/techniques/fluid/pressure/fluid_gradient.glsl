// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_GRADIENT
#define ESTAMPE_FLUID_GRADIENT

// Subtracts the pressure gradient from a velocity. Requires two texel buffers, `pressure` and `solids`.
// Include fluid_gradient.glsl after fluid_fields.glsl; the requirements of fluid_fields.glsl apply.

bool is_solid(uint index)
{
    return (variant & fluid_bit_solids) != 0u && texelFetch(solids, int(index)).x != 0u;
}

// One velocity component minus the pressure gradient.
float projected(sampler2DArray velocity, ivec3 cell, int axis)
{
    uint here = fluid_cell_index(cell);
    ivec3 before = cell;
    before[axis] = cell[axis] == 0 ? fluid_size()[axis] - 1 : cell[axis] - 1;
    uint there = fluid_cell_index(before);
    if (is_on_wall(axis, cell)) {
        return 0.0;
    }
    float speed = texelFetch(velocity, ivec3(cell.xy, axis * int(grid.depth) + cell.z), 0).x;
    if (is_solid(here) || is_solid(there)) {
        return speed;
    }
    return speed - (texelFetch(pressure, int(here)).x - texelFetch(pressure, int(there)).x);
}

#endif
