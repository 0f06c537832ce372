// SPDX-License-Identifier: MIT
// One thread per node of the disc tree combines the node's children.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) buffer Discs
{
    Disc discs[];
};

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

void main()
{
    uint item = item_index();
    uint level = constants.level;
    if (item >= constants.counts[level]) {
        return;
    }
    uint below = 0u;
    for (uint i = 0u; i + 1u < level; ++i) {
        below += constants.counts[i];
    }
    uint first = disc_children * item;
    uint count = min(disc_children, constants.counts[level - 1u] - first);
    Disc sum = Disc(vec3(0.0), 0.0, vec3(0.0), 0.0);
    for (uint i = 0u; i < count; ++i) {
        Disc disc = discs[below + first + i];
        sum.place += disc.area_m2 * disc.place;
        sum.facing_m2 += disc.facing_m2;
        sum.area_m2 += disc.area_m2;
    }
    sum.place /= sum.area_m2;
    for (uint i = 0u; i < count; ++i) {
        Disc disc = discs[below + first + i];
        sum.radius_m = max(sum.radius_m, distance(disc.place, sum.place) + disc.radius_m);
    }
    discs[below + constants.counts[level - 1u] + item] = sum;
}
