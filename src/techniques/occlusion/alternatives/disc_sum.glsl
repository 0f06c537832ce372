// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISC_SUM
#define ESTAMPE_DISC_SUM

// Occlusion of a place by discs, and the light that the discs bounce onto the place. Define before:
// DISCS_BINDING, the binding of the tree's texels (the discs' colours are at the next binding); DISCS_BOUNCE,
// whether to sum bounced light; `constants`, which holds DiscConstants.

#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(binding = DISCS_BINDING) uniform samplerBuffer disc_texels;
layout(binding = DISCS_BINDING + 1) uniform samplerBuffer disc_colors;

Disc disc_at(uint disc)
{
    vec4 a = texelFetch(disc_texels, int(2u * disc));
    vec4 b = texelFetch(disc_texels, int(2u * disc + 1u));
    return Disc(a.xyz, a.w, b.xyz, b.w);
}

// Index of the first node of a level in the tree of discs.
uint first_of(uint level)
{
    uint first = 0u;
    for (uint i = 0u; i < level; ++i) {
        first += constants.counts[i];
    }
    return first;
}

// Area of a tree node, projected in the direction of the unit vector `way`: exact for one disc and for
// coplanar discs. For normals in all directions it is a quarter of the area.
float facing_area(Disc disc, vec3 way)
{
    float along = dot(disc.facing_m2, way);
    float flatness = min(sqrt(dot(disc.facing_m2, disc.facing_m2)) / disc.area_m2, 1.0f);
    float both_sides = mix(0.5f * disc.area_m2, abs(along), flatness);
    return max(0.5f * (both_sides + along), 0.0f);
}

// Occlusion of a receiver by one disc; the vector `way` leads from the receiver to the disc. The occlusion is
// the disc's form factor, faded to 0 at the distance `radius_m`. The form factor depends on the disc's area,
// its distance, and the angles between `way` and the normals of receiver and disc.
float hidden_by_disc(Disc disc, vec3 way, vec3 normal, float radius_m)
{
    float r_2 = dot(way, way);
    if (r_2 <= 1e-12f || disc.area_m2 <= 0.0f) {
        return 0.0f;
    }
    vec3 towards = way * inversesqrt(r_2);
    float left = max(1.0f - r_2 / (radius_m * radius_m), 0.0f);
    float above = max(dot(normal, towards), 0.0f);
    return left * facing_area(disc, -towards) * above / (3.14159265f * r_2 + disc.area_m2);
}

struct DiscSum {
    float hidden;
    vec3 bounced;
};

// Sums the occlusion by all discs over the tree: a distant node counts as one disc, and the children of near
// nodes are visited. All lanes of a subgroup must call sum_of_discs() together.
DiscSum sum_of_discs(vec3 place, vec3 normal, bool is_there)
{
    uint top = constants.level_count - 1u;
    uint level = top;
    uint node = 0u;
    uint first = first_of(top);
    DiscSum sum = DiscSum(0.0, vec3(0.0));
    bool goes_on = is_there;
    // All lanes of a subgroup leave the loop together, because the subgroup would compute a finished lane
    // anyway.
    do {
        Disc disc = disc_at(first + node);
        vec3 way = disc.place - place;
        float away = sqrt(dot(way, way));
        bool is_out_of_reach = away - disc.radius_m > constants.radius_m;
        bool is_whole = level == 0u || is_out_of_reach || disc.radius_m < constants.apart * away;
        float hidden = goes_on && is_whole ? hidden_by_disc(disc, way, normal, constants.radius_m) : 0.0;
        sum.hidden += hidden;
        if (DISCS_BOUNCE) {
            sum.bounced += hidden * texelFetch(disc_colors, int(first + node)).rgb;
        }
        // The traversal of the tree moves to the first child, or to the next node. After a parent's last
        // child, the traversal moves up.
        bool goes_down = goes_on && !is_whole;
        bool goes_past = goes_on && is_whole;
        level -= goes_down ? 1u : 0u;
        first -= goes_down ? constants.counts[level] : 0u;
        node = goes_down ? node * disc_children : goes_past ? node + 1u : node;
        for (uint i = 0u; i < most_disc_levels - 1u; ++i) {
            bool goes_up =
                goes_past && level < top && (node % disc_children == 0u || node == constants.counts[level]);
            first += goes_up ? constants.counts[level] : 0u;
            node = goes_up ? (node + disc_children - 1u) / disc_children : node;
            level += goes_up ? 1u : 0u;
        }
        goes_on = goes_on && !(level == top && node >= constants.counts[top]);
    } while (subgroupAny(goes_on));
    // Occlusion cannot exceed 1. If the sum exceeds 1, the sum and the bounced light are both scaled down.
    sum.bounced /= max(sum.hidden, 1.0);
    return sum;
}

#endif
