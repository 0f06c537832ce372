// SPDX-License-Identifier: MIT
// One thread per cell: MacCormack's correction (fluid_correct.glsl), then the changes of quantities in a step
// (fluid_matter.glsl). One pass saves a write and a read of all quantities.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(scalar, binding = 0) readonly buffer Shapes
{
    FluidShape shape_list[];
};

layout(binding = 1) uniform sampler2DArray ways;
layout(binding = 2) uniform sampler2DArray field;
layout(binding = 3) uniform sampler2DArray advected;
layout(binding = 4, r32f) writeonly uniform image2DArray out_quantities;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidShapes shapes;
    FluidMatter matter;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/matter/fluid_shapes.glsl"
#include "techniques/fluid/matter/fluid_matter.glsl"
#include "techniques/fluid/motion/fluid_correct.glsl"
#include "techniques/fluid/motion/fluid_ways.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    int depth = int(grid.depth);
    vec3 back = way_of_cell(cell, 0);
    vec3 forth = way_of_cell(cell, depth);
    float amounts[fluid_most_channels];
    for (int i = 0; i < most_channels; ++i) {
        amounts[i] = i < int(shapes.channels) ? corrected(fluid_scalar, cell, i * depth, back, forth) : 0.0;
    }
    settle(amounts, cell);
    for (int i = 0; i < most_channels; ++i) {
        if (i < int(shapes.channels)) {
            imageStore(out_quantities, ivec3(cell.xy, i * depth + cell.z), vec4(amounts[i]));
        }
    }
}
