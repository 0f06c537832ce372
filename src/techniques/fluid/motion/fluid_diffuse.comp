// SPDX-License-Identifier: MIT
// One thread per cell: one stage of diffusion of the velocity under a uniform force.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray start;
layout(binding = 1) uniform sampler2DArray last;
layout(binding = 2) uniform sampler2DArray before_last;
layout(binding = 3, r32f) writeonly uniform image2DArray out_velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidDiffuse stage;
};

#include "techniques/fluid/fluid_fields.glsl"

// Laplacian at a node: the sum of the neighbours' values minus the number of neighbours times the node's
// value.
float laplacian(sampler2DArray velocity, int component, ivec3 cell)
{
    int first_layer = component * int(grid.depth);
    vec4 near;
    vec4 far;
    box_nodes(velocity, component, cell - 1, first_layer, near, far);
    vec4 lower = is_volume() ? far : near; // values of the node's own slice
    float below = near.w;
    box_nodes(velocity, component, cell, first_layer, near, far);
    float sum = lower.y + lower.z + near.y + near.z - 4.0 * near.x;
    return is_volume() ? sum + below + far.x - 2.0 * near.x : sum;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    for (int i = 0; i < fluid_dimensions(); ++i) {
        ivec3 texel = ivec3(cell.xy, i * int(grid.depth) + cell.z);
        float value = stage.of_last * texelFetch(last, texel, 0).x +
                      stage.of_before_last * texelFetch(before_last, texel, 0).x +
                      stage.of_start * texelFetch(start, texel, 0).x +
                      stage.of_last_rate * laplacian(last, i, cell) +
                      stage.of_start_rate * laplacian(start, i, cell) + stage.speed_gain[i];
        imageStore(out_velocity, texel, vec4(is_on_wall(i, cell) ? 0.0 : value));
    }
}
