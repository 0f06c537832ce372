// SPDX-License-Identifier: MIT
// One thread per cell computes the drawn density of smoke that burns or is moist. Cloud and flames count as
// density; flames also emit light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_fire = (variant & smoke_has_fire) != 0u;
const bool has_cloud = (variant & smoke_has_cloud) != 0u;

layout(binding = 0) uniform sampler2DArray quantities;
layout(binding = 1, r32f) writeonly uniform image2DArray out_density;
layout(binding = 2, r16f) writeonly uniform image2DArray out_fire;

layout(push_constant, scalar) uniform Constants
{
    SmokeSeen seen;
};

float amount_of(uint channel, ivec3 cell)
{
    return max(texelFetch(quantities, cell + ivec3(0, 0, channel * seen.cells.z), 0).x, 0.0);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(uvec3(cell), seen.cells))) {
        return;
    }
    float dense = amount_of(0u, cell);
    float fire = 0.0;
    if (has_cloud) {
        dense += amount_of(smoke_cloud, cell);
    }
    if (has_fire) {
        float hot = smoothstep(0.5 * seen.ignition, seen.ignition, amount_of(smoke_temperature, cell));
        float burning = min(seen.flame * hot * amount_of(smoke_fuel, cell), 1.0);
        fire = burning * burning; // squared, so that the thin ends of flames do not light up shade
        dense = max(dense, burning);
    }
    imageStore(out_density, cell, vec4(dense));
    imageStore(out_fire, cell, vec4(fire));
}
