// SPDX-License-Identifier: MIT
// The minimum of two numbers, written in four ways.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

const uint by_min = 0u;
const uint by_if = 1u;
const uint by_choice = 2u;  // c ? x : y
const uint by_numbers = 3u; // weights 0 and 1

uint at_most(uint x)
{
    if (variant == by_min) {
        return min(x, a);
    }
    if (variant == by_if) {
        if (x > a) {
            x = a;
        }
        return x;
    }
    if (variant == by_choice) {
        return x > a ? a : x;
    }
    uint over = uint(x > a);
    return (1u - over) * x + over * a;
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    uint x = i;
    for (uint r = 0u; r < rounds; ++r) {
        x = at_most(stir(x + r));
        x = at_most(stir(x));
        x = at_most(stir(x));
        x = at_most(stir(x));
    }
    results[i] = x;
}
