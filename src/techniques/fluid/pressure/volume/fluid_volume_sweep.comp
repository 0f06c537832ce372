// SPDX-License-Identifier: MIT
// One thread per cell of a level of the 3D multigrid: half a red-black sweep, which changes only the red or
// only the black cells. On the way to coarser levels, the first half sweep starts from zero; on the way back,
// the first half sweep adds the coarser level's pressure.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;
layout(binding = 2) uniform samplerBuffer pressure;
layout(binding = 3) uniform samplerBuffer coarse_pressure;

layout(scalar, binding = 4) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidVolumeLevel level;
    FluidVolumeSweep sweep;
};

#include "techniques/fluid/pressure/volume/fluid_volume_level.glsl"

float pressure_at(ivec3 cell)
{
    if ((variant & fluid_bit_from_zero) != 0u) {
        return 0.0;
    }
    float sum = texelFetch(pressure, index_of(cell)).x;
    if ((variant & fluid_bit_prolonging) != 0u) {
        ivec3 coarse = cell / 2;
        sum +=
            texelFetch(coarse_pressure,
                       (coarse.z * int(sweep.coarse_height) + coarse.y) * int(sweep.coarse_width) + coarse.x)
                .x;
    }
    return sum;
}

float relaxed(ivec3 cell)
{
    vec3 lower = lower_openings(cell);
    float sum = -texelFetch(divergence, index_of(cell)).x;
    float all_open = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        float upper = upper_opening(cell, axis);
        sum += lower[axis] * pressure_at(neighbour(cell, axis, -1)) +
               upper * pressure_at(neighbour(cell, axis, 1));
        all_open += lower[axis] + upper;
    }
    return all_open > 0.0 ? sum / all_open : 0.0;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, level_size()))) {
        return;
    }
    bool is_swept = ((cell.x + cell.y + cell.z) & 1) == int(sweep.color);
    out_pressure[index_of(cell)] = is_swept ? relaxed(cell) : pressure_at(cell);
}
