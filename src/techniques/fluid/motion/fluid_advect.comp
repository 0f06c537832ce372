// SPDX-License-Identifier: MIT
// One thread a cell: what comes to its nodes along the flow, looked up where it was before (semi-Lagrangian).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform sampler2DArray field;
layout(binding = 2, r32f) writeonly uniform image2DArray out_field;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/motion/fluid_cubic.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    bool are_scalars = (variant & fluid_bit_scalars) != 0u;
    vec3 way = vec3(0.0);
    for (int i = 0; i < int(advect.channels); ++i) {
        int component = are_scalars ? fluid_scalar : i;
        if (!are_scalars || i == 0) {
            vec3 at = place_of_node(component);
            vec3 here = velocity_at_node(velocity, component, cell);
            way = way_along(velocity, here, cell, at, -advect.cells_per_speed);
        }
        int first_layer = i * int(grid.depth);
        float value;
        if ((variant & fluid_bit_cubic) == 0u) {
            value = sample_linear(field, component, cell, first_layer, way);
        } else {
            value = sample_cubic(field, component, cell, first_layer, way);
            if (are_scalars) {
                vec2 range = range_of_nodes(field, component, cell, first_layer, way);
                value = clamp(value, range.x, range.y);
            }
        }
        value = is_on_wall(component, cell) ? 0.0 : value;
        imageStore(out_field, ivec3(cell.xy, first_layer + cell.z), vec4(value));
    }
}
