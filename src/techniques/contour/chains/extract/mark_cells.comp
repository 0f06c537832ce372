// SPDX-License-Identifier: MIT
// A subgroup tests 32 cells of the page lattice (a grid of points on the page) and writes one word: a bit is
// set if a line runs through the cell.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 1) buffer Marks
{
    uint marks[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

#include "techniques/contour/chains/extract/page_cells.glsl"

#define CROSSINGS_BINDING 0
#include "techniques/contour/chains/extract/page_lines.glsl"

bool has_line(uint index)
{
    uvec2 cell = point_of_cell(index);
    bool is_cell = cell.x + 1u < constants.columns && cell.y + 1u < constants.rows;
    return is_cell && line_through(is_cell ? cell : uvec2(0u)).is_there;
}

void main()
{
    uint word_count = (constants.columns * constants.rows + 31u) / 32u;
    uint step = gl_NumWorkGroups.x * gl_NumSubgroups;
    for (uint word = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID; word < word_count; word += step) {
        uint lines = 0u;
        for (uint first = 0u; first < 32u; first += gl_SubgroupSize) {
            bool is_line = has_line(32u * word + first + gl_SubgroupInvocationID);
            lines |= subgroupBallot(is_line && first + gl_SubgroupInvocationID < 32u).x << first;
        }
        if (subgroupElect()) {
            marks[constants.first_word + word] = lines;
        }
    }
}
