// SPDX-License-Identifier: MIT
// Dependent reads, in workgroups that use more or less shared memory.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint words_held = 64u;

#include "lab_compute.glsl"

layout(scalar, binding = 1) readonly buffer Words
{
    uint words[];
};

shared uint held[words_held];

void main()
{
    uint i = item_index();
    uint lane = gl_LocalInvocationID.x;
    held[lane * b % words_held] = i;
    barrier();
    uint p = held[(lane ^ 1u) * b % words_held] * 16u & a;
    uint sum = 0u;
    for (uint r = 0u; r < rounds; ++r) {
        p = words[p];
        sum += p;
    }
    if (i < threads) {
        results[i] = sum;
    }
}
