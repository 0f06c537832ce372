// SPDX-License-Identifier: MIT
// One workgroup: sweeps the coarsest level of the 3D multigrid until the pressure has converged. Subtracts
// the mean divergence of all cells first, because no pressure could remove the mean.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;

layout(scalar, binding = 2) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidVolumeLevel level;
};

#include "techniques/fluid/pressure/volume/fluid_volume_level.glsl"

const int half_sweeps = 48;

shared float cell_pressure[fluid_coarsest_cells];
shared float cell_divergence[fluid_coarsest_cells];

float relaxed(ivec3 cell, float mean)
{
    vec3 lower = lower_openings(cell);
    float sum = mean - cell_divergence[index_of(cell)];
    float all_open = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        float upper = upper_opening(cell, axis);
        sum += lower[axis] * cell_pressure[index_of(neighbour(cell, axis, -1))] +
               upper * cell_pressure[index_of(neighbour(cell, axis, 1))];
        all_open += lower[axis] + upper;
    }
    return all_open > 0.0 ? sum / all_open : 0.0;
}

void main()
{
    int i = int(gl_LocalInvocationIndex);
    ivec3 size = level_size();
    int count = size.x * size.y * size.z;
    bool is_there = i < count;
    ivec3 cell = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    cell_pressure[i] = 0.0;
    cell_divergence[i] = is_there ? texelFetch(divergence, i).x : 0.0;
    barrier();
    float mean = 0.0;
    for (int k = 0; k < count; ++k) {
        mean += cell_divergence[k] / float(count);
    }
    for (int k = 0; k < half_sweeps; ++k) {
        bool is_swept = is_there && ((cell.x + cell.y + cell.z + k) & 1) == 0;
        float next = is_swept ? relaxed(cell, mean) : cell_pressure[i];
        barrier();
        cell_pressure[i] = next;
        barrier();
    }
    if (is_there) {
        out_pressure[i] = cell_pressure[i];
    }
}
