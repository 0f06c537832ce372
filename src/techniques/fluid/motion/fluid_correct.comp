// SPDX-License-Identifier: MIT
// One thread a cell: MacCormack's correction of what semi-Lagrangian advection blurred. Carried back, its
// result should be what was there; half of the difference is added, within the range of the nodes that it
// came from.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray ways;
layout(binding = 1) uniform sampler2DArray field;
layout(binding = 2) uniform sampler2DArray advected;
layout(binding = 3, r32f) writeonly uniform image2DArray out_field;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/motion/fluid_ways.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    bool are_scalars = (variant & fluid_bit_scalars) != 0u;
    int depth = int(grid.depth);
    vec3 own_back = way_of_cell(cell, 0);
    vec3 own_forth = way_of_cell(cell, depth);
    vec3 back = own_back;
    vec3 forth = own_forth;
    int count = are_scalars ? int(advect.channels) : fluid_dimensions();
    for (int i = 0; i < count; ++i) {
        int component = are_scalars ? fluid_scalar : i;
        if (!are_scalars) {
            back = way_of_node(component, cell, 0, own_back);
            forth = way_of_node(component, cell, depth, own_forth);
        }
        int first_layer = i * depth;
        ivec3 texel = ivec3(cell.xy, first_layer + cell.z);
        float returned = sample_linear(advected, component, cell, first_layer, forth);
        float value = texelFetch(advected, texel, 0).x + 0.5 * (texelFetch(field, texel, 0).x - returned);
        vec2 range = range_of_nodes(field, component, cell, first_layer, back);
        value = is_on_wall(component, cell) ? 0.0 : clamp(value, range.x, range.y);
        imageStore(out_field, texel, vec4(value));
    }
}
