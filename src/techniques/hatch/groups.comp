// SPDX-License-Identifier: MIT
// Finds areas of one tone, for grouping the darkness of strokes. One thread handles one pixel, in one of
// several steps. Connected pixels of the same tone form an area. Areas are found by union and find on the
// pixels' numbers: each pixel refers to a pixel of the same area with a smaller number. Playne and Hawick, "A
// New Algorithm for Parallel Connected-Component Labelling on GPUs", IEEE TPDS 2018.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require

#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Constants
{
    GroupConstants constants;
};

#include "techniques/hatch/groups.glsl"

layout(constant_id = 0) const uint this_step = 0u;

uint name_of(uint number)
{
    uint parent = parents[number];
    while (parent != number) {
        number = parent;
        parent = parents[number];
    }
    return number;
}

void unite(uint a, uint b)
{
    a = name_of(a);
    b = name_of(b);
    while (a != b) {
        uint later = max(a, b);
        uint earlier = min(a, b);
        // Another thread may have given `later` a parent in the meantime, which is then united instead.
        uint before = atomicMin(parents[later], earlier);
        a = before == later ? earlier : name_of(before);
        b = name_of(earlier);
    }
}

bool is_small(uint name)
{
    return float(pixels_of[name]) < constants.least_px;
}

void start(ivec2 pixel)
{
    uint number = number_of(pixel);
    uint group = group_at(pixel);
    bool joins_left = pixel.x % 8 != 0 && group_at(pixel - ivec2(1, 0)) == group;
    bool joins_above = pixel.y % 8 != 0 && group_at(pixel - ivec2(0, 1)) == group;
    parents[number] = joins_left ? number - 1u : joins_above ? number - constants.size_px.x : number;
    if (!joins_left && !joins_above) {
        pixels_of[number] = 0u;
        for (int tone = 0; tone < int(constants.count); ++tone) {
            imageStore(borders, ivec3(pixel, tone), uvec4(0u));
        }
    }
}

void unite_with_neighbours(ivec2 pixel)
{
    uint number = number_of(pixel);
    uint group = group_at(pixel);
    bool left = group_at(pixel - ivec2(1, 0)) == group;
    bool above = group_at(pixel - ivec2(0, 1)) == group;
    if (left && pixel.x % 8 == 0) {
        unite(number, number - 1u);
    }
    // If the pixel to the left also joins the pixel above it, both rows are already united there.
    if (above && !(left && group_at(pixel - ivec2(1, 1)) == group)) {
        unite(number, number - constants.size_px.x);
    }
}

void measure(ivec2 pixel)
{
    uint number = number_of(pixel);
    uint name = name_of(number);
    parents[number] = name;
    // Large areas need no exact count, and counting all their pixels would be slow.
    if (float(pixels_of[name]) > full_area * constants.least_px) {
        return;
    }
    if (subgroupAllEqual(name)) {
        uint count = subgroupBallotBitCount(subgroupBallot(true));
        if (subgroupElect()) {
            atomicAdd(pixels_of[name], count);
        }
    } else {
        atomicAdd(pixels_of[name], 1u);
    }
}

void count_borders(ivec2 pixel)
{
    uint name = parents[number_of(pixel)];
    if (float(pixels_of[name]) > full_area * constants.least_px) {
        return;
    }
    uint group = group_at(pixel);
    for (int i = 0; i < 4; ++i) {
        ivec2 at = pixel + ivec2(i < 2 ? 2 * i - 1 : 0, i < 2 ? 0 : 2 * i - 5);
        uint beyond = group_at(at);
        if (beyond != no_group && beyond != group && !is_small(parents[number_of(at)])) {
            imageAtomicAdd(borders, border_texel(name, beyond), 1u);
        }
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    if (this_step == groups_start) {
        start(pixel);
    } else if (group_at(pixel) != no_group) {
        if (this_step == groups_unite) {
            unite_with_neighbours(pixel);
        } else if (this_step == groups_measure) {
            measure(pixel);
        } else {
            count_borders(pixel);
        }
    }
}
