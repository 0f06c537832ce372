// SPDX-License-Identifier: MIT
// One workgroup lists the triangles whose bits are set, in order, and writes the number of corners to draw.
// Each thread counts a range of words, and lists its triangles after the triangles of the previous threads.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/raster.glsl.h"

#define THREADS 64u
layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Kept
{
    uint kept[];
};

layout(scalar, binding = 1) writeonly buffer Listed
{
    uint listed[]; // numbers within the batch of the triangles to draw
};

layout(scalar, binding = 2) writeonly buffer Arguments
{
    uint arguments[]; // a VkDrawIndirectCommand
};

layout(push_constant, scalar) uniform Constants
{
    DrawConstants constants;
};

shared uint counts[THREADS];

void main()
{
    uint words = (constants.triangle_count + 31u) / 32u;
    uint share = (words + THREADS - 1u) / THREADS;
    uint first = min(gl_LocalInvocationID.x * share, words);
    uint last = min(first + share, words);
    uint count = 0u;
    for (uint word = first; word < last; ++word) {
        count += uint(bitCount(kept[word]));
    }
    counts[gl_LocalInvocationID.x] = count;
    barrier();
    uint at = 0u;
    for (uint i = 0u; i < gl_LocalInvocationID.x; ++i) {
        at += counts[i];
    }
    for (uint word = first; word < last; ++word) {
        for (uint bits = kept[word]; bits != 0u; bits &= bits - 1u) {
            listed[at] = 32u * word + uint(findLSB(bits));
            ++at;
        }
    }
    if (gl_LocalInvocationID.x == THREADS - 1u) {
        arguments[0] = 3u * at;
        arguments[1] = 1u;
        arguments[2] = 0u;
        arguments[3] = 0u;
    }
}
