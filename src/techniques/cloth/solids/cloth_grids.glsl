// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_GRIDS
#define ESTAMPE_CLOTH_GRIDS

// Solids that numbers on a grid tell of, as those of cloth_solids.glsl.

#include "techniques/cloth/cloth_data.glsl"

float grid_number(int at)
{
    return texelFetch(grid_texels, at).x;
}

#include "techniques/cloth/solids/cloth_heights.glsl"

vec4 distances_at(int first, vec3 half_m, vec3 place)
{
    ivec3 nodes = grid_nodes(first);
    vec3 own_half_m = vec3(grid_number(first + 3), grid_number(first + 4), grid_number(first + 5));
    vec3 scale = half_m / own_half_m;
    vec3 at = in_cells(place, half_m, nodes);
    ivec3 cell = min(ivec3(at), nodes - 2);
    vec3 f = at - vec3(cell);
    vec4 lower; // x by x, y by y
    vec4 upper;
    for (int i = 0; i < 4; ++i) {
        int corner = first + int(cloth_grid_head) + (cell.z * nodes.y + cell.y + (i >> 1)) * nodes.x +
                     cell.x + (i & 1);
        lower[i] = grid_number(corner);
        upper[i] = grid_number(corner + nodes.x * nodes.y);
    }
    vec4 flat_four = mix(lower, upper, f.z);
    vec2 row = mix(flat_four.xz, flat_four.yw, f.x);
    vec4 rise = upper - lower;
    vec2 rise_row = mix(rise.xz, rise.yw, f.x);
    vec3 rises = vec3(mix(flat_four.y - flat_four.x, flat_four.w - flat_four.z, f.y), row.y - row.x,
                      mix(rise_row.x, rise_row.y, f.y));
    vec3 slope = rises * vec3(nodes - 1) / half_m;
    float steepness = length(slope);
    float distance_m = mix(row.x, row.y, f.y) * min(scale.x, min(scale.y, scale.z));
    vec3 beyond = place - clamp(place, -half_m, half_m);
    float beyond_m = length(beyond);
    if (beyond_m > 0.0) {
        return vec4(beyond / beyond_m, max(beyond_m, distance_m - beyond_m));
    }
    return vec4(steepness > 1e-9 ? slope / steepness : vec3(0.0, 1.0, 0.0), distance_m);
}

#endif
