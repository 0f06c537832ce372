// SPDX-License-Identifier: MIT
// One workgroup turns a list of numbers into the sums of all before each, with the total at the end: each
// thread adds up a stretch, the sums of stretches are added up among threads, and each thread walks its
// stretch once more.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

#define THREADS 256u
layout(local_size_x = 256) in;

layout(scalar, binding = 0) buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer Values
{
    uint values[];
};

layout(scalar, binding = 2) writeonly buffer Before
{
    uint before[];
};

layout(push_constant, scalar) uniform Constants
{
    ScanConstants constants;
};

shared uint sums[THREADS];

uint value_at(uint i)
{
    return constants.counts_bits != 0u ? uint(bitCount(values[i])) : values[i];
}

void main()
{
    uint thread = gl_LocalInvocationIndex;
    uint count = constants.fixed_count;
    if (constants.count_of != NO_LIST) {
        count += sizes[constants.count_of].count;
    }
    uint share = (count + THREADS - 1u) / THREADS;
    uint first = min(thread * share, count);
    uint last = min(first + share, count);
    uint sum = 0u;
    for (uint i = first; i < last; ++i) {
        sum += value_at(i);
    }
    sums[thread] = sum;
    barrier();
    for (uint reach = 1u; reach < THREADS; reach *= 2u) {
        uint lower = thread >= reach ? sums[thread - reach] : 0u;
        barrier();
        sums[thread] += lower;
        barrier();
    }
    uint running = sums[thread] - sum;
    for (uint i = first; i < last; ++i) {
        before[i] = running;
        running += value_at(i);
    }
    if (thread == THREADS - 1u) {
        before[count] = running;
        uint kept = min(running, constants.capacity);
        if (constants.total_to != NO_LIST) {
            sizes[constants.total_to] = ListSize(kept, (kept + 63u) / 64u, 1u, 1u);
        }
        if (constants.slots_before != NO_LIST) {
            uint slots = constants.slots_before + kept;
            sizes[LIST_SLOTS] = ListSize(slots, (slots + 63u) / 64u, 1u, 1u);
        }
    }
}
