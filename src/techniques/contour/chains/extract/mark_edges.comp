// SPDX-License-Identifier: MIT
// A subgroup looks at 32 edges that shading breaks at and writes one word: along which some outline runs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/variants.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/extract/silhouette.glsl"

layout(binding = 3) uniform usamplerBuffer loose_edge_texels; // both sides of each

layout(binding = 4) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 5
#include "techniques/contour/chains/extract/facing.glsl"

layout(scalar, binding = 6) buffer Marks
{
    uint marks[];
};

layout(scalar, binding = 7) writeonly buffer Parts
{
    uint parts[]; // part_ bits, one an edge
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool along_edges = (variant & mark_along_edges) != 0u;

#include "techniques/contour/chains/extract/triangle_sides.glsl"
#include "techniques/contour/chains/extract/outline_edge.glsl"

void main()
{
    uint first_word = (constants.triangle_count + 31u) / 32u;
    uint word_count = (constants.loose_edge_count + 31u) / 32u;
    uint step = gl_NumWorkGroups.x * gl_NumSubgroups;
    uint word = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    do {
        uint outline = 0u;
        for (uint first = 0u; first < 32u; first += gl_SubgroupSize) {
            uint edge = 32u * word + first + gl_SubgroupInvocationID;
            uint last = constants.loose_edge_count - 1u;
            uint part = outline_part(texelFetch(loose_edge_texels, int(min(edge, last))).xy);
            bool is_there = edge <= last && first + gl_SubgroupInvocationID < 32u;
            outline |= subgroupBallot((part & part_is_there) != 0u && is_there).x << first;
            if (is_there) {
                parts[edge] = part;
            }
        }
        if (subgroupElect() && word < word_count) {
            marks[first_word + word] = outline;
        }
        word += step;
    } while (word < word_count);
}
