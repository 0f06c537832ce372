// SPDX-License-Identifier: MIT
// One thread per cell: changes the velocity by a uniform force, by lift from heat, weight from density,
// friction and vorticity confinement.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1) uniform sampler2DArray quantities;
// Vorticity confinement force at cell centres, only in 3D.
layout(binding = 2) uniform sampler2DArray confining;
layout(binding = 3, r32f) writeonly uniform image2DArray out_velocity;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidForces forces;
};

#include "techniques/fluid/fluid_fields.glsl"

// Vorticity confinement in 2D (strengthens small vortices); for 3D see fluid_confine.comp. Source: Steinhoff
// and Underhill, "Modification of the Euler equations for vorticity confinement", Physics of Fluids 6, 1994.

// Vorticity at the low corner of a cell, for cells of size 1.
float vorticity_at(ivec2 corner)
{
    ivec2 size = fluid_size().xy;
    ivec2 kept = ivec2(is_periodic(0) ? corner.x : clamp(corner.x, 0, size.x),
                       is_periodic(1) ? corner.y : clamp(corner.y, 0, size.y));
    vec4 across = plane_nodes(velocity, 0, kept - ivec2(0, 1), 0);
    vec4 up = plane_nodes(velocity, 1, kept - ivec2(1, 0), 1);
    return (up.y - up.x) - (across.z - across.x);
}

// Direction towards stronger vorticity, at most 1 long.
vec2 towards_vortex(vec2 gradient)
{
    return gradient * inversesqrt(dot(gradient, gradient) + 1e-12);
}

// Vorticity confinement force on the cell's faces towards lower x and lower y, one component per face.
vec2 confining_force(ivec3 cell)
{
    float at[9];
    for (int i = 0; i < 9; ++i) {
        at[i] = vorticity_at(cell.xy + ivec2(i % 3, i / 3) - 1);
    }
    float here = abs(at[4]);
    float above = abs(at[7]);
    float right = abs(at[5]);
    vec2 on_x = vec2(0.25 * (abs(at[5]) + abs(at[8]) - abs(at[3]) - abs(at[6])), above - here);
    vec2 on_y = vec2(right - here, 0.25 * (abs(at[7]) + abs(at[8]) - abs(at[1]) - abs(at[2])));
    return vec2(towards_vortex(on_x).y * 0.5 * (at[4] + at[7]),
                -towards_vortex(on_y).x * 0.5 * (at[4] + at[5]));
}

// Gain of vertical speed by lift and weight, at the face between a cell and the cell below it.
float buoyancy(ivec3 cell)
{
    int depth = int(grid.depth);
    ivec3 below = cell - ivec3(0, 1, 0);
    below.y = below.y < 0 ? int(grid.height) - 1 : below.y;
    vec2 here = vec2(texelFetch(quantities, ivec3(cell.xy, fluid_density * depth + cell.z), 0).x,
                     texelFetch(quantities, ivec3(cell.xy, fluid_temperature * depth + cell.z), 0).x);
    vec2 there = vec2(texelFetch(quantities, ivec3(below.xy, fluid_density * depth + cell.z), 0).x,
                      texelFetch(quantities, ivec3(below.xy, fluid_temperature * depth + cell.z), 0).x);
    return dot(0.5 * (here + there), vec2(-forces.weight, forces.lift));
}

// Vorticity confinement force in 3D, on a cell's faces towards the cell's lower neighbours.
vec3 confining_force_of_volume(ivec3 cell)
{
    vec3 here = texelFetch(confining, cell, 0).xyz;
    vec3 force;
    for (int axis = 0; axis < 3; ++axis) {
        force[axis] = 0.5 * (here[axis] + texelFetch(confining, neighbour(cell, axis, -1), 0)[axis]);
    }
    return force;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec3 gain = forces.speed_gain;
    if ((variant & fluid_bit_buoyant) != 0u) {
        gain.y += buoyancy(cell);
    }
    if ((variant & fluid_bit_confined) != 0u) {
        gain += forces.confinement *
                (is_volume() ? confining_force_of_volume(cell) : vec3(confining_force(cell), 0.0));
    }
    for (int i = 0; i < fluid_dimensions(); ++i) {
        ivec3 texel = ivec3(cell.xy, i * int(grid.depth) + cell.z);
        float speed = forces.kept * texelFetch(velocity, texel, 0).x + gain[i];
        float closeness = closeness_to_rim(vec3(cell) + place_of_node(i), forces.rim_cells);
        speed = mix(speed, forces.outside[i], closeness * forces.rim_share);
        imageStore(out_velocity, texel, vec4(is_on_wall(i, cell) ? 0.0 : speed));
    }
}
