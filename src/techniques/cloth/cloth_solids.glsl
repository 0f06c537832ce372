// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SOLIDS
#define ESTAMPE_CLOTH_SOLIDS

// Solids in their own space: the way out in xyz, of length 1, and in w how far it is to the surface, negative
// within. Of an ellipsoid, of grids and of bodies that is exact on the surface alone.

#include "techniques/cloth/cloth_grids.glsl"
#include "techniques/cloth/cloth_seen.glsl"
#include "techniques/cloth/cloth_turns.glsl"

// Ellipsoids, boxes, cylinders and capsules by one formula: processors go through all that kinds have of
// their own. A cylinder is a box in the plane of its axis, without an end the third way, and a capsule what
// is so near a box of no width.
vec4 rounded_at(uint kind, vec3 half_m, vec3 place)
{
    bool is_ellipsoid = kind == cloth_ellipsoid;
    bool is_cylinder = kind == cloth_cylinder;
    bool is_capsule = kind == cloth_capsule;
    float off_axis_m = length(place.xz);
    vec3 own = is_cylinder ? vec3(off_axis_m, place.y, 0.0) : place;
    vec3 core_m = vec3(is_capsule ? 0.0 : half_m.x, half_m.y,
                       is_cylinder  ? 1e9
                       : is_capsule ? 0.0
                                    : half_m.z);
    float radius_m = is_capsule ? half_m.x : 0.0;
    vec3 side = vec3(own.x < 0.0 ? -1.0 : 1.0, own.y < 0.0 ? -1.0 : 1.0, own.z < 0.0 ? -1.0 : 1.0);
    vec3 beyond = abs(own) - core_m;
    vec3 off = is_ellipsoid ? own / half_m : side * max(beyond, vec3(0.0));
    vec3 slope = is_ellipsoid ? off / half_m : off;
    float share = length(off);
    float steepness = length(slope);
    float deepest_m = max(beyond.x, max(beyond.y, beyond.z));
    vec3 inward = beyond.x > max(beyond.y, beyond.z) ? vec3(side.x, 0.0, 0.0)
                  : beyond.y > beyond.z              ? vec3(0.0, side.y, 0.0)
                                                     : vec3(0.0, 0.0, side.z);
    float out_m = is_ellipsoid ? share * (share - 1.0) / steepness : share - radius_m;
    vec4 solid = share > (is_ellipsoid ? 1e-4 : 0.0) ? vec4(slope / steepness, out_m)
                 : is_ellipsoid                      ? vec4(0.0, 1.0, 0.0, -half_m.y)
                                                     : vec4(inward, deepest_m - radius_m);
    vec2 outward = off_axis_m > 1e-9 ? place.xz / off_axis_m : vec2(1.0, 0.0);
    solid.xz = is_cylinder ? solid.x * outward : solid.xz;
    return solid;
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
    return kind == cloth_plane ? vec4(0.0, 1.0, 0.0, place.y) : rounded_at(kind, half_m, place);
}

#endif
