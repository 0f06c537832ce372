// SPDX-License-Identifier: MIT
// One thread a cell: how dense the smoke is that is drawn there: as a heap of puffs, so that its edge is
// scalloped, or as it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/rounds.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_puffs = (variant & smoke_has_puffs) != 0u;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 1) uniform sampler2DArray density; // the first `depth` layers
layout(binding = 2) uniform samplerBuffer puff_texels;
layout(binding = 3, r16f) writeonly uniform image2DArray out_shape;

layout(push_constant, scalar) uniform Constants
{
    SmokeTurn turn;
};

const float soft_cells = 1.5; // in which a puff ends

// How far within the deepest of the puffs about a place it is, in cells; negative outside. A puff's middle
// strays by less than half of the lattice, and is less than one of it large: 27 may reach a place.
float depth_in_puffs(vec3 place)
{
    vec3 at = (place - smoke.boxes[turn.box].puffs_risen) / smoke.boxes[turn.box].puff_cells;
    ivec3 home = ivec3(floor(at) - smoke.boxes[turn.box].puffs_from);
    ivec3 counts = ivec3(smoke.boxes[turn.box].puff_counts);
    float deepest = -1e3;
    for (int i = 0; i < rounds(27, int(place.x)); ++i) {
        ivec3 knot = clamp(home + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, ivec3(0), counts - 1);
        vec4 puff = texelFetch(puff_texels, (knot.z * counts.y + knot.y) * counts.x + knot.x);
        deepest = max(deepest, puff.w > 0.0 ? puff.w - length(place - puff.xyz) : -1e3);
    }
    return deepest;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, ivec3(smoke.boxes[turn.box].cells)))) {
        return;
    }
    float dense = max(texelFetch(density, cell, 0).x, 0.0);
    if (has_puffs) {
        dense = clamp(0.5 + depth_in_puffs(vec3(cell) + 0.5) / soft_cells, 0.0, 1.0);
    }
    imageStore(out_shape, cell + ivec3(0, 0, smoke.boxes[turn.box].first_layer), vec4(dense));
}
