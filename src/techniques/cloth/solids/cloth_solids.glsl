// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SOLIDS
#define ESTAMPE_CLOTH_SOLIDS

// Solids in the solids' own coordinates. Each function returns the unit direction to the outside in xyz, and
// the signed distance to the surface in w, negative inside. For ellipsoids, grids and bodies the distance is
// only exact on the surface.

// Solids given as distances on a grid.

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
    vec4 lower; // values at the cell's corners; x varies fastest, then y
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

#include "techniques/cloth/solids/cloth_seen.glsl"
#include "techniques/cloth/solids/cloth_turns.glsl"

vec4 ellipsoid_at(vec3 radii_m, vec3 place)
{
    vec3 unit_place = place / radii_m;
    vec3 slope = unit_place / radii_m;
    float share = length(unit_place);
    float steepness = length(slope);
    if (share < 1e-4) {
        return vec4(0.0, 1.0, 0.0, -radii_m.y);
    }
    return vec4(slope / steepness, share * (share - 1.0) / steepness);
}

// Distance and direction from a box with the half sides `half_m`, in two or three dimensions.
vec4 box_at(vec3 half_m, vec3 place)
{
    vec3 beyond = abs(place) - half_m;
    vec3 side = vec3(place.x < 0.0 ? -1.0 : 1.0, place.y < 0.0 ? -1.0 : 1.0, place.z < 0.0 ? -1.0 : 1.0);
    vec3 outside = max(beyond, vec3(0.0));
    float distance_m = length(outside);
    if (distance_m > 0.0) {
        return vec4(side * outside / distance_m, distance_m);
    }
    vec3 way = beyond.x > beyond.y && beyond.x > beyond.z ? vec3(side.x, 0.0, 0.0)
               : beyond.y > beyond.z                      ? vec3(0.0, side.y, 0.0)
                                                          : vec3(0.0, 0.0, side.z);
    return vec4(way, max(beyond.x, max(beyond.y, beyond.z)));
}

vec4 cylinder_at(float radius_m, float half_height_m, vec3 place)
{
    float off_axis_m = sqrt(place.x * place.x + place.z * place.z);
    vec3 outward = off_axis_m > 1e-9 ? vec3(place.x, 0.0, place.z) / off_axis_m : vec3(1.0, 0.0, 0.0);
    // A cylinder is a box in the plane of distance from the axis and height, so the third dimension of the
    // box is made irrelevant.
    vec4 flat_box = box_at(vec3(radius_m, half_height_m, 1e9), vec3(off_axis_m, place.y, 0.0));
    return vec4(flat_box.x * outward + vec3(0.0, flat_box.y, 0.0), flat_box.w);
}

vec4 capsule_at(float radius_m, float half_length_m, vec3 place)
{
    vec3 off = place - vec3(0.0, clamp(place.y, -half_length_m, half_length_m), 0.0);
    float distance_m = length(off);
    return vec4(distance_m > 1e-9 ? off / distance_m : vec3(1.0, 0.0, 0.0), distance_m - radius_m);
}

vec4 solid_at(uint kind_and_grid, vec3 half_m, vec3 place)
{
    uint kind = kind_and_grid & ((1u << cloth_kind_bits) - 1u);
    if ((variant & cloth_bit_seen) != 0u && kind == cloth_seen) {
        return seen_at(half_m, place);
    }
    if ((variant & cloth_bit_grids) != 0u && kind >= cloth_heights) {
        int first = int(kind_and_grid >> cloth_kind_bits);
        return kind == cloth_heights ? heights_at(first, half_m, place) : distances_at(first, half_m, place);
    }
    if (kind == cloth_ellipsoid) {
        return ellipsoid_at(half_m, place);
    }
    if (kind == cloth_box) {
        return box_at(half_m, place);
    }
    if (kind == cloth_cylinder) {
        return cylinder_at(half_m.x, half_m.y, place);
    }
    if (kind == cloth_capsule) {
        return capsule_at(half_m.x, half_m.y, place);
    }
    return vec4(0.0, 1.0, 0.0, place.y);
}

#endif
