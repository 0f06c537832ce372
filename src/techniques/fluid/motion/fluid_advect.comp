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
layout(binding = 2) uniform sampler2DArray ways; // of the variant that has them
layout(binding = 3, r32f) writeonly uniform image2DArray out_field;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/motion/fluid_cubic.glsl"
#include "techniques/fluid/motion/fluid_ways.glsl"

// Back along the flow.
vec3 way_back(int component, ivec3 cell, vec3 own)
{
    if ((variant & fluid_bit_ways) != 0u) {
        return way_of_node(component, cell, 0, own);
    }
    vec3 here = velocity_at_node(velocity, component, cell);
    return way_along(velocity, here, cell, place_of_node(component), -advect.cells_per_speed);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    bool are_scalars = (variant & fluid_bit_scalars) != 0u;
    vec3 own = (variant & fluid_bit_ways) != 0u ? way_of_cell(cell, 0) : vec3(0.0);
    vec3 way = vec3(0.0);
    int count = are_scalars ? int(advect.channels) : fluid_dimensions();
    for (int i = 0; i < count; ++i) {
        int component = are_scalars ? fluid_scalar : i;
        if (!are_scalars || i == 0) {
            way = way_back(component, cell, own);
        }
        int first_layer = i * int(grid.depth);
        float value;
        if ((variant & fluid_bit_cubic) == 0u) {
            value = sample_linear(field, component, cell, first_layer, way);
        } else {
            CubicSample found = sample_cubic(field, component, cell, first_layer, way);
            value = are_scalars ? clamp(found.value, found.range.x, found.range.y) : found.value;
        }
        value = is_on_wall(component, cell) ? 0.0 : value;
        imageStore(out_field, ivec3(cell.xy, first_layer + cell.z), vec4(value));
    }
}
