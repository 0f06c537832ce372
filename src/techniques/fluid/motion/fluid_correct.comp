// SPDX-License-Identifier: MIT
// One thread a cell: MacCormack's correction, see fluid_correct.glsl. For quantities that change on the way
// see fluid_correct_matter.comp.
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
#include "techniques/fluid/motion/fluid_correct.glsl"
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
        float value = corrected(component, cell, first_layer, back, forth);
        imageStore(out_field, ivec3(cell.xy, first_layer + cell.z), vec4(value));
    }
}
