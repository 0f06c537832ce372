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

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform sampler2DArray field;
layout(binding = 2) uniform sampler2DArray advected;
layout(binding = 3, r32f) writeonly uniform image2DArray out_field;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"

// Half a step ahead the velocity is as much more as it is less half a step back, to the order of the midpoint
// rule, which saves looking it up; but where ways differ by more than this, in cells, it is looked up.
const float most_bend = 0.25;

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    bool are_scalars = (variant & fluid_bit_scalars) != 0u;
    vec3 back = vec3(0.0);
    vec3 forth = vec3(0.0);
    for (int i = 0; i < int(advect.channels); ++i) {
        int component = are_scalars ? fluid_scalar : i;
        if (!are_scalars || i == 0) {
            vec3 at = place_of_node(component);
            vec3 here = velocity_at_node(velocity, component, cell);
            vec3 half_back = velocity_half_way(velocity, here, cell, at, -advect.cells_per_speed);
            vec3 half_forth = 2.0 * here - half_back;
            if (length(advect.cells_per_speed * (here - half_back)) > most_bend) {
                half_forth = velocity_half_way(velocity, here, cell, at, advect.cells_per_speed);
            }
            back = kept_inside(-advect.cells_per_speed * half_back, cell, at);
            forth = kept_inside(advect.cells_per_speed * half_forth, cell, at);
        }
        int first_layer = i * int(grid.depth);
        ivec3 texel = ivec3(cell.xy, first_layer + cell.z);
        float returned = sample_linear(advected, component, cell, first_layer, forth);
        float value = texelFetch(advected, texel, 0).x + 0.5 * (texelFetch(field, texel, 0).x - returned);
        vec2 range = range_of_nodes(field, component, cell, first_layer, back);
        value = is_on_wall(component, cell) ? 0.0 : clamp(value, range.x, range.y);
        imageStore(out_field, texel, vec4(value));
    }
}
