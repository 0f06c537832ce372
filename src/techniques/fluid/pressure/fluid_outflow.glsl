// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_OUTFLOW
#define ESTAMPE_FLUID_OUTFLOW

// Needs what fluid_fields.glsl needs, and is included after it.

// Divergence of a cell, times its side.
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

#endif
