// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_CONTACT
#define ESTAMPE_CLOTH_CONTACT

// What particles run into.

#include "techniques/cloth/cloth_data.glsl"
#include "techniques/cloth/cloth_solids.glsl"

// A collider at a part of the run.
ClothCollider collider_at(uint collider, float part)
{
    int before = 3 * int(collider);
    int after = before + 3 * int(run.collider_stride);
    uvec4 place = texelFetch(collider_texels, before);
    vec3 place_after = uintBitsToFloat(texelFetch(collider_texels, after).xyz);
    vec4 turn = uintBitsToFloat(texelFetch(collider_texels, before + 1));
    vec4 turn_after = uintBitsToFloat(texelFetch(collider_texels, after + 1));
    vec4 size = uintBitsToFloat(texelFetch(collider_texels, before + 2));
    return ClothCollider(mix(uintBitsToFloat(place.xyz), place_after, part), place.w,
                         normalize(mix(turn, turn_after, part)), size.xyz, size.w);
}

// The way from `from` to `to` ends, or goes on along the surface, where it meets what is solid. All in the
// collider's own space, so that it may move meanwhile.
vec3 stopped(uint kind, vec3 half_m, vec3 from, vec3 to)
{
    float way_m = distance(from, to);
    vec3 hit = from;
    vec4 solid = solid_at(kind, half_m, from);
    float gone_m = 0.0;
    for (int i = 0; i < 12 && solid.w > sheet.thickness_m + 1e-6; ++i) {
        gone_m += solid.w - sheet.thickness_m;
        if (gone_m >= way_m) {
            return to;
        }
        hit = mix(from, to, gone_m / way_m);
        solid = solid_at(kind, half_m, hit);
    }
    float depth_m = max(sheet.thickness_m - solid.w - dot(to - hit, solid.xyz), 0.0);
    vec3 way = to + depth_m * solid.xyz - from;
    vec3 along = way - dot(way, solid.xyz) * solid.xyz;
    float along_m = length(along);
    float kept = along_m > 0.0 ? max(1.0 - sheet.friction * depth_m / along_m, 0.0) : 1.0;
    vec3 place = from + way + (kept - 1.0) * along;
    for (int i = 0; i < 3; ++i) {
        solid = solid_at(kind, half_m, place);
        place += max(sheet.thickness_m - solid.w, 0.0) * solid.xyz;
    }
    return place;
}

// Where a particle comes to that moves from `from` to `to` between two parts of a run.
vec3 beside_colliders(vec3 from, vec3 to, float begin, float end)
{
    for (uint i = 0u; i < run.collider_count; ++i) {
        ClothCollider before = collider_at(i, begin);
        ClothCollider after = collider_at(i, end);
        vec3 from_there = from - before.centre_m;
        vec3 way = to - after.centre_m - from_there;
        float nearest = clamp(-dot(from_there, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
        if (length(from_there + nearest * way) <= before.reach_m + sheet.thickness_m) {
            vec3 own_from = turned_back(before.rotation, from_there);
            vec3 own_to = turned_back(after.rotation, to - after.centre_m);
            vec3 place = stopped(after.kind, after.half_m, own_from, own_to);
            to = after.centre_m + turned(after.rotation, place);
        }
    }
    return to;
}

#endif
