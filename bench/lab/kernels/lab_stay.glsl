// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_STAY
#define ESTAMPE_LAB_STAY

// One in ten squares of `a` by `a` pixels has anything to do.

#include "lab.glsl"

const uint leaves_early = 1u;

bool stays(uvec2 pixel)
{
    uvec2 square = pixel / a;
    return scattered(square.y * 4096u + square.x) % 10u == 0u;
}

uint worked_on(uvec2 pixel)
{
    uint x = pixel.y * 4096u + pixel.x;
    for (uint r = 0u; r < rounds; ++r) {
        x = stir(x);
    }
    return x;
}

#endif
