// SPDX-License-Identifier: MIT
// A subgroup tests 32 triangles and writes two words. The bits of the first word mark triangles that face the
// eye. The bits of the second mark triangles through which the outline of the smooth surface runs.
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
#include "techniques/contour/chains/extract/silhouette.glsl"

layout(scalar, binding = 3) writeonly buffer Facing
{
    uint facing[];
};

layout(scalar, binding = 4) writeonly buffer Marks
{
    uint marks[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool along_edges = (variant & mark_along_edges) != 0u;

// Returns two flags: the triangle faces the eye; the outline of the smooth surface runs through the triangle.
bvec2 look_at(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    bool is_mirrored = (corners.w & triangle_mirrored) != 0u;
    bool is_front = (facing_of(a.position, b.position, c.position) > 0.0) != is_mirrored;
    bool side_a = facing_at(a) >= 0.0;
    bool side_b = facing_at(b) >= 0.0;
    bool side_c = facing_at(c) >= 0.0;
    bool has_lines = corners.x != corners.y && corners.y != corners.z && corners.z != corners.x &&
                     (corners.w & triangle_is_flat) == 0u;
    return bvec2(is_front, !along_edges && has_lines && (side_a != side_b || side_b != side_c));
}

void main()
{
    uint word_count = (constants.triangle_count + 31u) / 32u;
    uint step = gl_NumWorkGroups.x * gl_NumSubgroups;
    uint word = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    do {
        uint front = 0u;
        uint outline = 0u;
        for (uint first = 0u; first < 32u; first += gl_SubgroupSize) {
            uint triangle = 32u * word + first + gl_SubgroupInvocationID;
            bvec2 seen = look_at(min(triangle, constants.triangle_count - 1u));
            bool is_there = triangle < constants.triangle_count && first + gl_SubgroupInvocationID < 32u;
            front |= subgroupBallot(seen.x && is_there).x << first;
            outline |= subgroupBallot(seen.y && is_there).x << first;
        }
        if (subgroupElect() && word < word_count) {
            facing[word] = front;
            marks[word] = outline;
        }
        word += step;
    } while (word < word_count);
}
