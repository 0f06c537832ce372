// SPDX-License-Identifier: MIT
// One thread a cell of a volume: the force in its middle that feeds vortices, from vorticity and how much of
// it there is. Source: Steinhoff and Underhill, "Modification of the Euler equations for vorticity
// confinement", Physics of Fluids 6, 1994.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray curl; // see fluid_curl.comp
layout(binding = 1, r32f) writeonly uniform image2DArray out_force;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"

float curl_at(ivec3 cell, int component)
{
    return texelFetch(curl, ivec3(cell.xy, component * int(grid.depth) + cell.z), 0).x;
}

void main()
{
    const int size_of_curl = 3;
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        gradient[axis] = curl_at(neighbour(cell, axis, 1), size_of_curl) -
                         curl_at(neighbour(cell, axis, -1), size_of_curl);
    }
    vec3 here = vec3(curl_at(cell, 0), curl_at(cell, 1), curl_at(cell, 2));
    // Towards where there is more of it, no longer than 1.
    vec3 force = cross(gradient * inversesqrt(dot(gradient, gradient) + 1e-12), here);
    for (int i = 0; i < 3; ++i) {
        imageStore(out_force, ivec3(cell.xy, i * int(grid.depth) + cell.z), vec4(force[i]));
    }
}
