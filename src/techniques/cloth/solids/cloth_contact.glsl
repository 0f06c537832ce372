// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_CONTACT
#define ESTAMPE_CLOTH_CONTACT

// Collision of particles with solids.
//
// Requires: vec4 met_ball(), a ball that a particle will hardly leave in the current step, and uint
// met_solids(uint word), one bit for each of 32 solids that come near the ball during the step.

#include "techniques/cloth/cloth_data.glsl"
#include "techniques/cloth/solids/cloth_met.glsl"
#include "techniques/cloth/solids/cloth_solids.glsl"

vec3 pushed_out(uint kind, vec3 half_m, vec3 place)
{
    float depth_m = 1.0;
    for (int i = 0; i < 3; ++i) {
        if (depth_m > 0.0) {
            vec4 solid = solid_at(kind, half_m, place);
            depth_m = max(sheet.thickness_m - solid.w, 0.0);
            place += depth_m * solid.xyz;
        }
    }
    return place;
}

// Moves a particle from `from` to `to`, and stops it at the solid's surface or lets it slide along the
// surface. `from` and `to` are in the coordinates of the collider, so the collider may move. `is_stopped`
// tells whether the result differs from `to`.
vec3 stopped(uint kind, vec3 half_m, vec3 from, vec3 to, out bool is_stopped)
{
    float way_m = distance(from, to);
    vec3 hit = from;
    vec4 solid = solid_at(kind, half_m, from);
    float gone_m = 0.0;
    bool meets = true;
    for (int i = 0; i < 12 && solid.w > sheet.thickness_m + 1e-6 && meets; ++i) {
        gone_m += solid.w - sheet.thickness_m;
        meets = gone_m < way_m;
        if (meets) {
            hit = mix(from, to, gone_m / way_m);
            solid = solid_at(kind, half_m, hit);
        }
    }
    float depth_m = max(sheet.thickness_m - solid.w - dot(to - hit, solid.xyz), 0.0);
    vec3 way = to + depth_m * solid.xyz - from;
    vec3 along = way - dot(way, solid.xyz) * solid.xyz;
    float along_m = length(along);
    float kept = along_m > 0.0 ? max(1.0 - sheet.friction * depth_m / along_m, 0.0) : 1.0;
    vec3 end = meets ? from + way + (kept - 1.0) * along : to;
    // For heights, distances and bodies the distance to the surface is not exact, so the particle is always
    // tested.
    bool is_pushed = meets || (variant & (cloth_bit_grids | cloth_bit_seen)) != 0u;
    vec3 beside = is_pushed ? pushed_out(kind, half_m, end) : end;
    is_stopped = meets || beside != end;
    return beside;
}

vec4 turn_between(vec4 before, vec4 after, float part)
{
    return normalize(before + part * (after - before));
}

// Moves a particle from `from` to `to` between two times of a run (shares `begin` and `end`), and returns the
// place after collision with one solid.
vec3 beside_collider(uint i, vec3 from, vec3 to, float begin, float end)
{
    int before = 3 * int(i);
    int after = before + 3 * int(run.collider_stride);
    vec3 centre_before = uintBitsToFloat(texelFetch(collider_texels, before).xyz);
    uvec4 place_after = texelFetch(collider_texels, after);
    vec3 centre_after = uintBitsToFloat(place_after.xyz);
    vec4 size = uintBitsToFloat(texelFetch(collider_texels, after + 2));
    vec3 centre_way = centre_after - centre_before; // exactly 0 for a solid that does not move
    vec3 from_there = from - (centre_before + begin * centre_way);
    vec3 centre_m = centre_before + end * centre_way;
    vec3 way = to - centre_m - from_there;
    float nearest = clamp(-dot(from_there, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
    if (length(from_there + nearest * way) > size.w + sheet.thickness_m) {
        return to;
    }
    vec4 rotation_before = uintBitsToFloat(texelFetch(collider_texels, before + 1));
    vec4 rotation = rotation_before;
    if (run.collider_stride != 0u) {
        vec4 rotation_after = uintBitsToFloat(texelFetch(collider_texels, after + 1));
        rotation = turn_between(rotation_before, rotation_after, end);
        rotation_before = turn_between(rotation_before, rotation_after, begin);
    }
    vec3 own_from = turned_back(rotation_before, from_there);
    vec3 own_to = turned_back(rotation, to - centre_m);
    if ((variant & cloth_bit_seen) != 0u && (place_after.w & ((1u << cloth_kind_bits) - 1u)) == cloth_seen) {
        look_at_body(int(place_after.w >> cloth_kind_bits),
                     uintBitsToFloat(texelFetch(collider_texels, before + 2).xyz), end);
        own_from.z += surface_way_m(size.xyz, own_from, begin, end);
    }
    bool is_stopped;
    vec3 own_end = stopped(place_after.w, size.xyz, own_from, own_to, is_stopped);
    return is_stopped ? centre_m + turned(rotation, own_end) : to;
}

// Moves a particle with collision against all solids, one after another. While the particle is inside the
// ball that it will hardly leave, solids away from the ball are skipped. Once the particle leaves the ball,
// no solid is skipped.
vec3 beside_colliders(vec3 from, vec3 to, float begin, float end)
{
    vec4 ball = met_ball();
    bool strays = !(distance(from, ball.xyz) <= ball.w);
    uint first = 0u;
    do {
        uint left = run.collider_count - first;
        uint all = left < 32u ? (1u << left) - 1u : ~0u;
        strays = strays || !(distance(to, ball.xyz) <= ball.w);
        uint met = strays || first >= 32u * cloth_met_words ? all : all & met_solids(first / 32u);
        do {
            if (met != 0u) {
                uint i = uint(findLSB(met));
                to = beside_collider(first + i, from, to, begin, end);
                strays = strays || !(distance(to, ball.xyz) <= ball.w);
                met = (strays ? all : met) & ~((2u << i) - 1u);
            }
        } while (met != 0u);
        first += 32u;
    } while (first < run.collider_count);
    return to;
}

#endif
