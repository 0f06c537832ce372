// SPDX-License-Identifier: MIT
// One thread per cell: sets velocities on faces of obstacles to the obstacle's velocity, and accelerates the
// fluid inside a source towards the source's velocity.
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

layout(binding = 1) uniform usamplerBuffer solids;
layout(binding = 2, r32f) uniform image2DArray velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidShapes shapes;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/matter/fluid_shapes.glsl"

uint solid_at(ivec3 cell)
{
    return (variant & fluid_bit_solids) == 0u ? 0u : texelFetch(solids, int(fluid_cell_index(cell))).x;
}

float pushed(float speed, int axis, vec3 place_m)
{
    for (uint i = shapes.obstacle_count; i < shapes.count; ++i) {
        FluidShape shape = shape_list[i];
        float share = cover_of(shape, place_m) * (1.0 - exp(-shape.push * shapes.step_s));
        speed = mix(speed, speed_of(shape, place_m)[axis], share);
    }
    return speed;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    for (int axis = 0; axis < fluid_dimensions(); ++axis) {
        if (is_on_wall(axis, cell)) {
            continue;
        }
        ivec3 before = cell;
        before[axis] = cell[axis] == 0 ? fluid_size()[axis] - 1 : cell[axis] - 1;
        uint solid = solid_at(cell);
        solid = solid == 0u ? solid_at(before) : solid;
        vec3 place_m = (vec3(cell) + place_of_node(axis)) * shapes.cell_m;
        ivec3 texel = ivec3(cell.xy, axis * int(grid.depth) + cell.z);
        float speed = solid == fluid_stands_still ? 0.0
                      : solid != 0u               ? speed_of(shape_list[solid - 1u], place_m)[axis]
                                                  : pushed(imageLoad(velocity, texel).x, axis, place_m);
        imageStore(velocity, texel, vec4(speed));
    }
}
