// SPDX-License-Identifier: MIT
// A subgroup looks at 32 edges that shading breaks at and writes one word: along which some outline runs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/frame.glsl.h"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/silhouette.glsl"

layout(scalar, binding = 3) readonly buffer LooseEdges
{
    uvec2 loose_edges[];
};

layout(binding = 4) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 5
#include "techniques/contour/chains/facing.glsl"

layout(scalar, binding = 6) buffer Marks
{
    uint marks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

// Bit 0: outlines run along the edges of the mesh, not through its triangles.
layout(constant_id = 0) const uint variant = 0u;
const bool along_edges = (variant & 1u) != 0u;

#include "techniques/contour/chains/outline_edge.glsl"

void main()
{
    uint first_word = (constants.triangle_count + 31u) / 32u;
    uint word_count = (constants.loose_edge_count + 31u) / 32u;
    uint step = gl_NumWorkGroups.x * gl_NumSubgroups;
    for (uint word = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID; word < word_count; word += step) {
        uint outline = 0u;
        for (uint first = 0u; first < 32u; first += gl_SubgroupSize) {
            uint edge = 32u * word + first + gl_SubgroupInvocationID;
            uvec2 sides = loose_edges[min(edge, constants.loose_edge_count - 1u)];
            bool is_outline = has_outline(fronts_along(sides));
            bool is_there = edge < constants.loose_edge_count && first + gl_SubgroupInvocationID < 32u;
            outline |= subgroupBallot(is_outline && is_there).x << first;
        }
        if (subgroupElect()) {
            marks[first_word + word] = outline;
        }
    }
}
