// SPDX-License-Identifier: MIT
// Two kinds of work. Each block of threads does one kind.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

const uint does_both = 1u; // does both kinds of work, then selects a result
const uint in_a_line = 2u; // without a loop: 32 steps written out

#define FOUR(STEP) STEP STEP STEP STEP
#define THIRTY_TWO(STEP) FOUR(FOUR(STEP)) FOUR(FOUR(STEP))

uint one(uint x)
{
    if ((variant & in_a_line) != 0u) {
        THIRTY_TWO(x = stir(x);)
        return x;
    }
    for (uint r = 0u; r < rounds; ++r) {
        x = stir(x);
    }
    return x;
}

uint other(uint x)
{
    if ((variant & in_a_line) != 0u) {
        THIRTY_TWO(x = stir_otherwise(x);)
        return x;
    }
    for (uint r = 0u; r < rounds; ++r) {
        x = stir_otherwise(x);
    }
    return x;
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    bool takes_one = ((i / a) & 1u) == 0u;
    uint x = i;
    if ((variant & does_both) != 0u) {
        uint first = one(x);
        uint second = other(x);
        x = takes_one ? first : second;
    } else if (takes_one) {
        x = one(x);
    } else {
        x = other(x);
    }
    results[i] = x;
}
