// SPDX-License-Identifier: MIT
// One thread a cell: how dense the smoke is that is drawn there. Lumps are balls strewn through space that the
// flow takes along; they add to thin smoke or take away from it, so that its edge is scalloped.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "shaders/rounds.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_lumps = (variant & smoke_has_lumps) != 0u;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 1) uniform sampler2DArray density;  // the first `depth` layers
layout(binding = 2) uniform sampler2DArray velocity; // metres a second on faces, component by component
layout(binding = 3, r16f) writeonly uniform image2DArray out_shape;

float face_speed(ivec3 cell, int axis)
{
    ivec3 next = cell;
    next[axis] = min(cell[axis] + 1, int(smoke.cells[axis]) - 1);
    int first = axis * int(smoke.cells.z);
    return 0.5 * (texelFetch(velocity, ivec3(cell.xy, first + cell.z), 0).x +
                  texelFetch(velocity, ivec3(next.xy, first + next.z), 0).x);
}

// How deep within a ball of a set a place is, 1 in its middle; balls of size 0 to 1.
float depth_in_balls(vec3 place, uint set, float size, int count)
{
    vec3 low = floor(place - 0.5);
    float deepest = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 corner = low + vec3(i & 1, (i >> 1) & 1, i >> 2);
        uvec3 number = uvec3(ivec3(corner));
        uint identity = hash(number.x, hash(number.y, number.z), set);
        vec3 stray = vec3(unit_float(identity), unit_float(hash(identity + 1u)), unit_float(hash(identity + 2u)));
        float radius = size * mix(0.55, 0.85, unit_float(hash(identity + 3u)));
        vec3 off = place - (corner + 0.5 + 0.4 * (stray - 0.5));
        deepest = max(deepest, 1.0 - dot(off, off) / max(radius * radius, 1e-4));
    }
    return deepest;
}

float lump_at(ivec3 cell)
{
    vec3 speed = vec3(face_speed(cell, 0), face_speed(cell, 1), face_speed(cell, 2)) / smoke.cell_m;
    float deepest = 0.0;
    for (int set = 0; set < rounds(2, cell.x); ++set) {
        float share = smoke.lump_share + 0.5 * float(set);
        uint round_number = smoke.lump_round + (share >= 1.0 ? 1u : 0u);
        share = fract(share);
        vec3 place = vec3(cell) + 0.5 - smoke.lump_s * (share - 0.5) * speed;
        float size = sqrt(1.0 - abs(2.0 * share - 1.0));
        uint key = hash(2u * round_number + uint(set), smoke.seed);
        deepest = max(deepest, depth_in_balls(place / smoke.lump_cells, key, size, rounds(8, cell.x)));
    }
    return deepest;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, ivec3(smoke.cells)))) {
        return;
    }
    float dense = max(texelFetch(density, cell, 0).x, 0.0);
    if (has_lumps) {
        float share = min(dense, 1.0);
        float cut = share + smoke.lumps * (lump_at(cell) - 0.5) * 4.0 * share * (1.0 - share);
        dense = smoothstep(0.3, 0.7, cut);
    }
    imageStore(out_shape, cell, vec4(dense));
}
