// SPDX-License-Identifier: MIT
// One thread handles one slot (entry of the list of chains). The thread stores the number of the chain's
// points if its segment represents the chain. An open chain is represented by the first segment, a closed
// chain by the segment with the highest number.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer FeatureChains
{
    FeatureChain feature_chains[];
};

#define SEGMENTS_BINDING 2
#define RANKS_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) writeonly buffer PointsOfSlot
{
    uint points_of_slot[];
};

layout(scalar, binding = 5) writeonly buffer FlagsOfSlot
{
    uint flags_of_slot[];
};

layout(scalar, binding = 6) writeonly buffer FirstOfEnd
{
    uint first_of_end[]; // for the last segment of each open chain: the index of the chain's first segment
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= sizes[list_slots].count) {
        return;
    }
    uint point_count = 0u;
    uint flags = 0u;
    if (slot < constants.feature_chain_count) {
        point_count = feature_chains[slot].point_count;
        flags = feature_chains[slot].is_closed != 0u ? chain_is_closed : 0u;
    } else {
        uint segment = slot - constants.feature_chain_count;
        Rank rank = rank_at(segment);
        if (segment_at(rank.at).next == no_segment) {
            if (segment_at(segment).has_previous == 0u) {
                point_count = rank.steps + 2u;
                first_of_end[rank.at] = segment;
            }
        } else if (rank.highest == segment) {
            point_count = rank_at(segment_at(segment).next).steps_to_highest + 2u;
            flags = chain_is_closed;
        }
    }
    points_of_slot[slot] = point_count;
    flags_of_slot[slot] = flags;
}
