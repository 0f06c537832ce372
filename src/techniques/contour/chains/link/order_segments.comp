// SPDX-License-Identifier: MIT
// One thread stores one line segment at its place in the list of chain points.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/link/page_piece.glsl"

layout(scalar, binding = 1) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 4) readonly buffer FirstOfEnd
{
    uint first_of_end[];
};

#define SEGMENTS_BINDING 2
#define RANKS_BINDING 3
#define POINTS_BEFORE_BINDING 5
#include "techniques/contour/chains/lists.glsl"

#define MESH_TEXELS_BINDING 6
#include "shaders/mesh_texels.glsl"

layout(binding = 8) uniform usamplerBuffer neighbor_texels;

#include "techniques/contour/chains/link/shaded_round.glsl"

layout(scalar, binding = 9) buffer Points
{
    ChainPoint points[];
};

layout(scalar, binding = 10) buffer Lengths
{
    uint lengths[]; // length on the page from each point to the next, in 1/1024 pixel
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_segments].count) {
        return;
    }
    Rank rank = rank_at(index);
    bool is_open = segment_at(rank.at).next == no_segment;
    uint stands_for_chain;
    uint place;
    uint last;
    if (is_open) {
        stands_for_chain = first_of_end[rank.at];
        last = rank_at(stands_for_chain).steps;
        place = last - rank.steps;
    } else {
        stands_for_chain = rank.highest;
        last = rank_at(segment_at(stands_for_chain).next).steps_to_highest;
        place = rank.steps_to_highest == 0u ? 0u : last + 1u - rank.steps_to_highest;
    }
    uint at = points_before(constants.feature_chain_count + stands_for_chain) + place;
    if (at + 1u >= constants.point_capacity) {
        return;
    }
    Segment segment = segment_at(index);
    bool has_next = segment.next != no_segment;
    Segment next = segment_at(has_next ? segment.next : index);
    bool ends_round =
        has_next && is_round_at(uvec2(segment.source, next.source), segment.from, segment.to, next.to);
    points[at] = ChainPoint(segment.from, segment.from_normal, segment.bulge_m, segment.source,
                            ends_round ? 1u : 0u, 0u);
    lengths[at] = uint(length_unit_px * piece_on_page(segment.from, segment.to).length_px + 0.5);
    if (place == last) {
        points[at + 1u] = ChainPoint(segment.to, segment.to_normal, segment.bulge_m, segment.source, 0u, 0u);
        lengths[at + 1u] = 0u;
    }
}
