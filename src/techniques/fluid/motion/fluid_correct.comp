// SPDX-License-Identifier: MIT
// One thread per cell: MacCormack's correction of the velocity, see fluid_correct.glsl.
// fluid_correct_matter.comp corrects quantities.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray ways;
layout(binding = 1) uniform sampler2DArray field;
layout(binding = 2) uniform sampler2DArray advected;
layout(binding = 3, r32f) writeonly uniform image2DArray out_velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
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
    int depth = int(grid.depth);
    vec3 own_back = way_of_cell(cell, 0);
    vec3 own_forth = way_of_cell(cell, depth);
    for (int i = 0; i < fluid_dimensions(); ++i) {
        vec3 back = way_of_node(i, cell, 0, own_back);
        vec3 forth = way_of_node(i, cell, depth, own_forth);
        float value = corrected(i, cell, i * depth, back, forth);
        imageStore(out_velocity, ivec3(cell.xy, i * depth + cell.z), vec4(value));
    }
}
