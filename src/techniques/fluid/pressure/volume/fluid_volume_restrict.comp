// SPDX-License-Identifier: MIT
// One thread per cell of the coarser level of the 3D multigrid: the sum of the residuals of the cell's eight
// cells in the next finer level.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;
layout(binding = 2) uniform samplerBuffer pressure;

layout(scalar, binding = 3) writeonly buffer Coarse
{
    float out_divergence[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidVolumeLevel level;
};

#include "techniques/fluid/pressure/volume/fluid_volume_level.glsl"

float pressure_at(ivec3 cell)
{
    return texelFetch(pressure, index_of(cell)).x;
}

float residual(ivec3 cell)
{
    vec3 lower = lower_openings(cell);
    float own = pressure_at(cell);
    float left = texelFetch(divergence, index_of(cell)).x;
    for (int axis = 0; axis < 3; ++axis) {
        left -= lower[axis] * (pressure_at(neighbour(cell, axis, -1)) - own) +
                upper_opening(cell, axis) * (pressure_at(neighbour(cell, axis, 1)) - own);
    }
    return left;
}

void main()
{
    ivec3 coarse = ivec3(gl_GlobalInvocationID);
    ivec3 coarse_size = (level_size() + 1) / 2;
    if (any(greaterThanEqual(coarse, coarse_size))) {
        return;
    }
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        ivec3 cell = 2 * coarse + ivec3(i & 1, (i >> 1) & 1, i >> 2);
        if (all(lessThan(cell, level_size()))) {
            sum += residual(cell);
        }
    }
    out_divergence[(coarse.z * coarse_size.y + coarse.y) * coarse_size.x + coarse.x] = sum;
}
