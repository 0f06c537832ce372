// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISC_SUM
#define ESTAMPE_DISC_SUM

// What discs hide from a place and throw on it. Wanted before: DISCS_BINDING, of the tree as texels, their
// colours come next; DISCS_THROW, whether those count; `constants` that hold DiscConstants.

#include "techniques/occlusion/discs/disc_texels.glsl"
#include "techniques/occlusion/discs/discs.glsl"

layout(binding = DISCS_BINDING + 1) uniform samplerBuffer disc_colors;

struct DiscSum {
    float hidden;
    vec3 thrown;
};

// Those far off many at once: down the tree where a node is too near, past it where that has been looked at.
// All lanes of a subgroup come here together.
DiscSum sum_of_discs(vec3 place, vec3 normal, bool is_there)
{
    uint top = constants.level_count - 1u;
    uint level = top;
    uint node = 0u;
    uint first = first_of(top);
    DiscSum sum = DiscSum(0.0, vec3(0.0));
    bool goes_on = is_there;
    // All lanes leave together: one that has left would go on computing.
    do {
        Disc disc = disc_at(first + node);
        vec3 way = disc.place - place;
        float away = sqrt(dot(way, way));
        bool is_out_of_reach = away - disc.radius_m > constants.radius_m;
        bool is_whole = level == 0u || is_out_of_reach || disc.radius_m < constants.apart * away;
        float hidden = goes_on && is_whole ? hidden_by_disc(disc, way, normal, constants.radius_m) : 0.0;
        sum.hidden += hidden;
        if (DISCS_THROW) {
            sum.thrown += hidden * texelFetch(disc_colors, int(first + node)).rgb;
        }
        // Down to the first below, or on to the next and up where a node's last has been looked at.
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
    // More than all cannot be hidden, nor thrown back.
    sum.thrown /= max(sum.hidden, 1.0);
    return sum;
}

#endif
