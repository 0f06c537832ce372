// SPDX-License-Identifier: MIT
// One thread per cell: displacements of the cell's centre backward and forward along the flow, in cells, by
// the midpoint rule. Nodes on faces use the mean of the two adjacent cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
// Displacements, laid out as in fluid_ways.glsl.
layout(binding = 1, rgba16f) writeonly uniform image2DArray out_ways;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidAdvect advect;
};

#include "techniques/fluid/fluid_fields.glsl"

// The velocity half a step ahead is extrapolated from the velocity half a step back. That saves a texture
// read and preserves the order of the midpoint rule. If the two displacements differ by more than most_bend
// cells, the velocity half a step ahead is sampled.
const float most_bend = 0.25;

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec3 at = place_of_node(fluid_scalar);
    vec3 here = velocity_in_middle(velocity, cell);
    vec3 half_back = velocity_half_way(velocity, here, cell, at, -advect.cells_per_speed);
    vec3 half_forth = 2.0 * here - half_back;
    if (length(advect.cells_per_speed * (here - half_back)) > most_bend) {
        half_forth = velocity_half_way(velocity, here, cell, at, advect.cells_per_speed);
    }
    vec3 back = kept_inside(-advect.cells_per_speed * half_back, cell, at);
    vec3 forth = kept_inside(advect.cells_per_speed * half_forth, cell, at);
    imageStore(out_ways, cell, vec4(back, 0.0));
    imageStore(out_ways, cell + ivec3(0, 0, grid.depth), vec4(forth, 0.0));
}
