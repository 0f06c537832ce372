// SPDX-License-Identifier: MIT
// One thread per puff computes its centre and radius. Puffs are balls on a lattice that rises with the smoke;
// the radius depends on the density at the centre.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "shaders/loops.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

// Density in the first `depth` layers; other layers are not read.
layout(binding = 1) uniform sampler2DArray density;

layout(scalar, binding = 2) writeonly buffer Puffs
{
    vec4 out_puffs[]; // puffs as centre and radius, in cells
};

layout(push_constant, scalar) uniform Constants
{
    SmokeTurn turn;
};

float density_near(vec3 place, uvec3 cells)
{
    ivec3 cell = clamp(ivec3(floor(place)), ivec3(0), ivec3(cells) - 1);
    return texelFetch(density, cell, 0).x;
}

void main()
{
    uint item = item_index();
    uvec3 counts = smoke.boxes[turn.box].puff_counts;
    if (item >= counts.x * counts.y * counts.z) {
        return;
    }
    uvec3 number = uvec3(item % counts.x, item / counts.x % counts.y, item / (counts.x * counts.y));
    vec3 cells = vec3(smoke.boxes[turn.box].cells);
    float apart = smoke.boxes[turn.box].puff_cells;
    vec3 knot = smoke.boxes[turn.box].puffs_from + vec3(number);
    uvec3 key = uvec3(ivec3(knot));
    uint identity = hash(key.x, key.y, key.z ^ smoke.boxes[turn.box].seed);
    vec3 stray = vec3(unit_float(identity), unit_float(hash(identity + 1u)), unit_float(hash(identity + 2u)));
    vec3 middle = (knot + mix(vec3(smoke_least_stray), vec3(1.0 - smoke_least_stray), stray)) * apart +
                  smoke.boxes[turn.box].puffs_risen;
    float most = mix(0.5, smoke_most_puff, unit_float(hash(identity + 3u))) * apart;
    float radius = most * sqrt(smoothstep(0.1, 0.7, density_near(middle, uvec3(cells))));
    // The box's floor may cut off a part of a puff, but the box's other sides must not.
    vec3 inside = min(middle, cells - middle);
    inside.y = cells.y - middle.y;
    out_puffs[item] = vec4(middle, min(radius, min(inside.x, min(inside.y, inside.z))));
}
