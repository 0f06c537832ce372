// SPDX-License-Identifier: MIT
// Reads sixteen words of a buffer, in an order that is fast or slow for memory.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

layout(scalar, binding = 1) readonly buffer Words
{
    uint words[];
};

const uint side_by_side = 0u; // neighbouring threads read neighbouring words
const uint own_run = 1u;      // each thread reads consecutive words
const uint anywhere = 2u;

uint place(uint i, uint k)
{
    if (variant == side_by_side) {
        return k * threads + i;
    }
    return variant == own_run ? 16u * i + k : scattered(16u * i + k);
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    uint sum = 0u;
    for (uint k = 0u; k < 16u; ++k) {
        sum += words[place(i, k) & a];
    }
    results[i] = sum;
}
