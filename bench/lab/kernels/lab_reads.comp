// SPDX-License-Identifier: MIT
// Two or eight texture reads at identical places. Either each read depends on the previous read, or none
// does.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

layout(binding = 1) uniform usampler2D next; // next_of() of the texel's number

const uint each_needs_the_last = 1u;
const uint eight = 2u;

uint texel(uint p)
{
    return texelFetch(next, ivec2(p & ((1u << b) - 1u), p >> b), 0).x;
}

void read(inout uint p, inout uint sum)
{
    uint found = texel(p);
    sum += found;
    p = (variant & each_needs_the_last) != 0u ? found : next_of(p) & a;
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    uint p = scattered(i) & a;
    uint sum = 0u;
    for (uint r = 0u; r < rounds; ++r) {
        read(p, sum);
        read(p, sum);
        if ((variant & eight) != 0u) {
            read(p, sum);
            read(p, sum);
            read(p, sum);
            read(p, sum);
            read(p, sum);
            read(p, sum);
        }
    }
    results[i] = sum;
}
