// SPDX-License-Identifier: MIT
// A subgroup tests 32 triangles and writes one word: a bit is set if the triangle has a suggestive contour or
// a crest.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usamplerBuffer triangle_texels;

layout(scalar, binding = 2) buffer Marks
{
    uint marks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

#define VIEW_BENDS_BINDING 1
#include "techniques/contour/chains/extract/suggestive.glsl"

bool has_line(uint triangle)
{
    uvec4 corners = texelFetch(triangle_texels, int(triangle));
    BendSides sides = bend_sides(corners);
    BendCrossing down = bend_crossing(corners[sides.down], corners[(sides.down + 1u) % 3u]);
    BendCrossing up = bend_crossing(corners[sides.up], corners[(sides.up + 1u) % 3u]);
    return sides.are_there && max(down.strength, up.strength) > 0.0;
}

void main()
{
    uint word_count = (constants.suggestive_count + 31u) / 32u;
    uint first_word = word_count + (constants.loose_edge_count + 31u) / 32u;
    uint step = gl_NumWorkGroups.x * gl_NumSubgroups;
    uint word = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    do {
        uint lines = 0u;
        for (uint first = 0u; first < 32u; first += gl_SubgroupSize) {
            uint triangle = 32u * word + first + gl_SubgroupInvocationID;
            bool is_line = has_line(min(triangle, constants.suggestive_count - 1u));
            bool is_there = triangle < constants.suggestive_count && first + gl_SubgroupInvocationID < 32u;
            lines |= subgroupBallot(is_line && is_there).x << first;
        }
        if (subgroupElect() && word < word_count) {
            marks[first_word + word] = lines;
        }
        word += step;
    } while (word < word_count);
}
