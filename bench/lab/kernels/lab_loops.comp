// SPDX-License-Identifier: MIT
// Eight steps, in loops of several kinds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

const uint by_hand = 0u;
const uint known = 1u;          // the number of rounds is known to the compiler
const uint uniform_count = 2u;  // the number of rounds is known when the frame is drawn
const uint own_count = 3u;      // each thread has its own number of rounds
const uint as_long_as_any = 4u; // as own_count, but all threads run the largest possible number of rounds

const uint most = 15u;

uint own(uint i)
{
    return scattered(i / a) % most + 1u;
}

uint eight_steps(uint x, uint i)
{
    if (variant == by_hand) {
        x = stir(x);
        x = stir(x);
        x = stir(x);
        x = stir(x);
        x = stir(x);
        x = stir(x);
        x = stir(x);
        x = stir(x);
    } else if (variant == known) {
        for (uint k = 0u; k < 8u; ++k) {
            x = stir(x);
        }
    } else if (variant == as_long_as_any) {
        uint count = own(i);
        for (uint k = 0u; k < most; ++k) {
            uint further = stir(x);
            x = k < count ? further : x;
        }
    } else {
        uint count = variant == own_count ? own(i) : b;
        for (uint k = 0u; k < count; ++k) {
            x = stir(x);
        }
    }
    return x;
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    uint x = i;
    for (uint r = 0u; r < rounds; ++r) {
        x = eight_steps(x, i);
    }
    results[i] = x;
}
