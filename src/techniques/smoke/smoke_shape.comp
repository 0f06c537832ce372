// SPDX-License-Identifier: MIT
// One thread per cell computes the drawn density: a heap of puffs with a scalloped edge, or the simulated
// density.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_puffs = (variant & smoke_has_puffs) != 0u;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

// Density in the first `depth` layers; other layers are not read.
layout(binding = 1) uniform sampler2DArray density;
layout(binding = 2) uniform samplerBuffer puff_texels;
layout(binding = 3, r16f) writeonly uniform image2DArray out_shape;

layout(push_constant, scalar) uniform Constants
{
    SmokeTurn turn;
};

const float soft_cells = 1.5; // width of a puff's soft edge, in cells

// Range of lattice offsets, `first` to `last` from the lattice knot below a place, of puffs that may reach
// the place.
struct Knots {
    ivec3 first;
    ivec3 last;
};

Knots knots_about(vec3 within)
{
    float reach = smoke_most_puff + 0.5 * soft_cells / smoke.boxes[turn.box].puff_cells;
    bvec3 is_below_far = greaterThan(within + smoke_least_stray, vec3(reach));
    bvec3 is_above_near = lessThanEqual(1.0 + smoke_least_stray - within, vec3(reach));
    return Knots(ivec3(is_below_far) - 1, ivec3(is_above_near));
}

// Depth of a place inside the deepest puff around it, in cells; negative outside all puffs.
float depth_in_puffs(vec3 place)
{
    vec3 at = (place - smoke.boxes[turn.box].puffs_risen) / smoke.boxes[turn.box].puff_cells;
    vec3 below = floor(at);
    ivec3 home = ivec3(below - smoke.boxes[turn.box].puffs_from);
    ivec3 counts = ivec3(smoke.boxes[turn.box].puff_counts);
    Knots knots = knots_about(at - below);
    ivec3 size = knots.last - knots.first + 1;
    ivec3 aside = knots.first;
    float deepest = -1e3;
    for (int i = 0; i < loop_rounds(size.x * size.y * size.z, int(place.x)); ++i) {
        ivec3 knot = clamp(home + aside, ivec3(0), counts - 1);
        vec4 puff = texelFetch(puff_texels, (knot.z * counts.y + knot.y) * counts.x + knot.x);
        deepest = max(deepest, puff.w > 0.0 ? puff.w - length(place - puff.xyz) : -1e3);
        bool ends_row = aside.x == knots.last.x;
        bool ends_plane = ends_row && aside.y == knots.last.y;
        aside.x = ends_row ? knots.first.x : aside.x + 1;
        aside.y = ends_plane ? knots.first.y : ends_row ? aside.y + 1 : aside.y;
        aside.z = ends_plane ? aside.z + 1 : aside.z;
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
