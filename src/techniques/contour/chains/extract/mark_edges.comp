// SPDX-License-Identifier: MIT
// A subgroup tests 32 edges at which the shading breaks and writes one word: a bit is set if the edge has an
// outline.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"
#include "techniques/contour/chains/extract/silhouette.glsl"

// The two sides of each loose edge (an edge where the shading breaks, without a crease or other fixed line).
layout(binding = 3) uniform usamplerBuffer loose_edge_texels;

layout(binding = 4) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 5
#include "techniques/contour/chains/extract/facing.glsl"

layout(scalar, binding = 6) buffer Marks
{
    uint marks[];
};

layout(scalar, binding = 7) writeonly buffer Parts
{
    // The part of each loose edge (an edge without a crease or other fixed line) that is outline, as part_
    // bits.
    uint parts[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool along_edges = (variant & mark_along_edges) != 0u;

#include "techniques/contour/chains/extract/triangle_sides.glsl"

// An edge at which the shading breaks is part of the outline if the surface on one side of the edge faces the
// eye and the surface on the edge's other side does not. Each of the two surfaces is tested with the
// surface's own normals. Together, the outline's edges and the outlines through triangles enclose everything
// that faces the eye.

// Position between two vertices of a side at which the surface turns away from the eye.
float share_of_turn(PosedVertex from, PosedVertex to)
{
    float s_from = dot(unit(normal_direction(from.normal)), way_to_eye(from.position));
    float s_to = dot(unit(normal_direction(to.normal)), way_to_eye(to.position));
    return s_from / (s_from - s_to);
}

// The part of an edge that is outline, as part_ bits. An edge has no outline if only the edge's two ends
// would be outline but not the edge's middle.
uint outline_part(uvec2 sides)
{
    uvec2 ends = ends_of(sides.x);
    uvec2 back_ends = ends_of(sides.y).yx; // corners of the back triangle at the two ends of the edge
    uvec4 corners = triangle_at(sides.x >> 2);
    uvec4 back_corners = triangle_at(sides.y >> 2);
    bvec2 first = bvec2(is_front_at(sides.x >> 2, ends.x), is_front_at(sides.x >> 2, ends.y));
    bvec2 second = bvec2(is_front_at(sides.y >> 2, back_ends.x), is_front_at(sides.y >> 2, back_ends.y));
    bvec2 differs = bvec2(first.x != second.x, first.y != second.y);
    bool first_turns = first.x != first.y;
    bool second_turns = second.x != second.y;
    bool both_turn = first_turns && second_turns;
    bool is_there = (any(differs) || both_turn) && !(both_turn && differs.x);
    uint crossing = first_turns ? bound_in_first : bound_in_second;
    bool is_front = differs.x ? first.x : first.y;
    uint low = differs.x ? bound_is_corner : crossing;
    uint high = differs.y ? bound_is_corner : crossing;
    // If the surfaces on both sides of the edge turn away from the eye, the outline lies between the two
    // crossings. The order of the crossings decides which side is the front.
    bool comes_first =
        share_of_turn(posed_vertex_at(corners[ends.x]), posed_vertex_at(corners[ends.y])) <
        share_of_turn(posed_vertex_at(back_corners[back_ends.x]), posed_vertex_at(back_corners[back_ends.y]));
    is_front = both_turn ? first.x != comes_first : is_front;
    low = both_turn ? (comes_first ? bound_in_first : bound_in_second) : low;
    high = both_turn ? (comes_first ? bound_in_second : bound_in_first) : high;
    return is_there ? part_is_there | (is_front ? part_first_is_front : 0u) | low << part_low_shift |
                          high << part_high_shift
                    : 0u;
}

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
