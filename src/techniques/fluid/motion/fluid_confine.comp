// SPDX-License-Identifier: MIT
// One thread per cell of a 3D fluid: vorticity confinement force at the cell centre, from the vorticity and
// the vorticity's magnitude. Source: Steinhoff and Underhill, "Modification of the Euler equations for
// vorticity confinement", Physics of Fluids 6, 1994.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray curl; // curl of the velocity, from fluid_curl.comp
layout(binding = 1, rgba16f) writeonly uniform image2DArray out_force;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidConfine confine;
};

#include "techniques/fluid/fluid_fields.glsl"

vec4 curl_at(ivec3 cell)
{
    return texelFetch(curl, cell, 0);
}

// Factor on the confinement of a swirl: 1 + `surplus` for slow swirls, and 1 for swirls of the vorticity
// `swirl_most`. Faster swirls get less still, down to nothing, because the path of a step could not follow
// them if they got faster.
float fed_by_surplus(float vorticity, float surplus, float swirl_most)
{
    float share = vorticity / swirl_most;
    return max(1.0 + surplus * (1.0 - share * share), 0.0);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec4 here = curl_at(cell);
    // Strongest vorticity of the cell and its neighbours, because the force at the edge of a swirl feeds the
    // swirl's middle.
    float fastest = here.w;
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        float after = curl_at(neighbour(cell, axis, 1)).w;
        float before = curl_at(neighbour(cell, axis, -1)).w;
        gradient[axis] = after - before;
        fastest = max(fastest, max(after, before));
    }
    // Vorticity confinement: the force is perpendicular to the curl and to the gradient of the curl's
    // strength. The gradient is scaled to a length of at most 1.
    vec3 force = cross(gradient * inversesqrt(dot(gradient, gradient) + 1e-12), here.xyz);
    if (confine.surplus > 0.0) {
        force *= fed_by_surplus(fastest, confine.surplus, confine.swirl_most);
    }
    imageStore(out_force, cell, vec4(force, 0.0));
}
