// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_PIXELS
#define ESTAMPE_LAB_PIXELS

// What the kernels that draw a page do at each of its pixels.

#include "lab.glsl"

// Work whose outcome is linear, so that it may be done at corners and interpolated: it comes to x in the end.

const uint at_corners = 1u;

float worked_on(float x)
{
    float y = 0.0;
    for (uint r = 0u; r < rounds; ++r) {
        y += 0.5 * (x - y);
    }
    return y;
}

// A pixel that is copied, or worked on.

uint made_of(uint x)
{
    for (uint r = 0u; r < rounds; ++r) {
        x = stir(x);
    }
    return x;
}

// One in ten squares of `a` by `a` pixels has anything to do.

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
