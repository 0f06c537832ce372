// SPDX-License-Identifier: MIT
// One thread per cell: changes of quantities in a step, see fluid_matter.glsl.
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

layout(binding = 1, r32f) uniform image2DArray quantities;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidShapes shapes;
    FluidMatter matter;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/matter/fluid_shapes.glsl"
#include "techniques/fluid/matter/fluid_matter.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    float amounts[fluid_most_channels];
    for (int i = 0; i < most_channels; ++i) {
        amounts[i] = i < int(shapes.channels)
                         ? imageLoad(quantities, ivec3(cell.xy, i * int(grid.depth) + cell.z)).x
                         : 0.0;
    }
    settle(amounts, cell);
    for (int i = 0; i < most_channels; ++i) {
        if (i < int(shapes.channels)) {
            imageStore(quantities, ivec3(cell.xy, i * int(grid.depth) + cell.z), vec4(amounts[i]));
        }
    }
}
