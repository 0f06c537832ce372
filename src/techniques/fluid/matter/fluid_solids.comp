// SPDX-License-Identifier: MIT
// One thread per cell: number of the obstacle that contains the cell's centre, counted from 1, or 0.
// Permanently solid cells are marked only where no obstacle is.
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

// One word per cell: whether the cell is solid permanently. The buffer has a single word if no cell is solid
// permanently.
layout(binding = 1) uniform usamplerBuffer standing;

layout(scalar, binding = 2) writeonly buffer Solids
{
    uint out_solids[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidShapes shapes;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/matter/fluid_shapes.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec3 place_m = (vec3(cell) + 0.5) * shapes.cell_m;
    uint solid =
        (variant & fluid_bit_standing) == 0u ? 0u : texelFetch(standing, int(fluid_cell_index(cell))).x;
    for (uint i = shapes.obstacle_count; i > 0u; --i) {
        solid = distance_to(shape_list[i - 1u], place_m) < 0.0 ? i : solid;
    }
    out_solids[fluid_cell_index(cell)] = solid;
}
