// SPDX-License-Identifier: MIT
// Finds areas of one tone, for grouping the darkness of strokes. One thread handles one pixel, in one of
// several steps. Connected pixels of the same tone form an area. Areas are found by union and find on the
// pixels' names: each pixel refers to an earlier pixel of the same area. Playne and Hawick, "A
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

uint area_of(uint name)
{
    uint parent = parent_of(name);
    while (parent != name) {
        name = parent;
        parent = parent_of(name);
    }
    return name;
}

void unite(uint a, uint b)
{
    a = area_of(a);
    b = area_of(b);
    while (a != b) {
        uint later = max(a, b);
        uint earlier = min(a, b);
        // Another thread may have given `later` a parent in the meantime, which is then united instead.
        uint before = imageAtomicMin(parents, pixel_of(later), earlier);
        a = before == later ? earlier : area_of(before);
        b = area_of(earlier);
    }
}

bool is_small(uint area)
{
    return float(pixels_of(area)) < constants.least_px;
}

void start(ivec2 pixel)
{
    uint group = group_at(pixel);
    bool joins_left = pixel.x % 8 != 0 && group_at(pixel - ivec2(1, 0)) == group;
    bool joins_above = pixel.y % 8 != 0 && group_at(pixel - ivec2(0, 1)) == group;
    ivec2 parent = pixel - (joins_left ? ivec2(1, 0) : joins_above ? ivec2(0, 1) : ivec2(0));
    imageStore(parents, pixel, uvec4(name_at(parent)));
    if (parent == pixel) {
        for (int layer = 0; layer <= int(constants.count); ++layer) {
            imageStore(areas, ivec3(pixel, layer), uvec4(0u));
        }
    }
}

void unite_with_neighbours(ivec2 pixel)
{
    uint group = group_at(pixel);
    bool left = group_at(pixel - ivec2(1, 0)) == group;
    bool above = group_at(pixel - ivec2(0, 1)) == group;
    if (left && pixel.x % 8 == 0) {
        unite(name_at(pixel), name_at(pixel - ivec2(1, 0)));
    }
    // If the pixel to the left also joins the pixel above it, both rows are already united there.
    if (above && !(left && group_at(pixel - ivec2(1, 1)) == group)) {
        unite(name_at(pixel), name_at(pixel - ivec2(0, 1)));
    }
}

void measure(ivec2 pixel)
{
    uint area = area_of(name_at(pixel));
    imageStore(parents, pixel, uvec4(area));
    // Large areas need no exact count, and counting all their pixels would be slow.
    if (float(pixels_of(area)) > full_area * constants.least_px) {
        return;
    }
    ivec3 place = ivec3(pixel_of(area), 0);
    if (subgroupAllEqual(area)) {
        uint count = subgroupBallotBitCount(subgroupBallot(true));
        if (subgroupElect()) {
            imageAtomicAdd(areas, place, count);
        }
    } else {
        imageAtomicAdd(areas, place, 1u);
    }
}

void count_borders(ivec2 pixel)
{
    uint area = parent_of(name_at(pixel));
    if (float(pixels_of(area)) > full_area * constants.least_px) {
        return;
    }
    uint group = group_at(pixel);
    for (int i = 0; i < 4; ++i) {
        ivec2 at = pixel + ivec2(i < 2 ? 2 * i - 1 : 0, i < 2 ? 0 : 2 * i - 5);
        uint beyond = group_at(at);
        if (beyond != no_group && beyond != group && !is_small(parent_of(name_at(at)))) {
            imageAtomicAdd(areas, border_place(area, beyond), 1u);
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
