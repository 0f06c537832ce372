// SPDX-License-Identifier: MIT
// One thread per cell: subtracts the pressure gradient from the velocity.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform samplerBuffer pressure;
layout(binding = 2) uniform usamplerBuffer solids;
layout(binding = 3, r32f) writeonly uniform image2DArray out_velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/pressure/fluid_gradient.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        ivec3 texel = ivec3(cell.xy, axis * int(grid.depth) + cell.z);
        imageStore(out_velocity, texel, vec4(projected(velocity, cell, axis)));
    }
}
