// SPDX-License-Identifier: MIT
// One thread advances one segment by one round of pointer jumping: each round looks four times as far along
// the chain as the round before. The search stops at the end of an open chain. In a closed chain, the thread
// finds the segment with the highest number, which then counts as the first segment.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define RANKS_BINDING 1
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 2) writeonly buffer Ranks
{
    Rank ranks[];
};

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    uint count = sizes[list_segments].count;
    if (slot >= count) {
        return;
    }
    Rank rank = rank_at(slot);
    uint jump = 0u;
    do {
        Rank there = rank_at(rank.at);
        if (there.highest > rank.highest) {
            rank.highest = there.highest;
            rank.steps_to_highest = rank.steps + there.steps_to_highest;
        }
        rank.at = there.at;
        rank.steps += there.steps;
        ++jump;
    } while (jump < min(3u, count));
    ranks[slot] = rank;
}
