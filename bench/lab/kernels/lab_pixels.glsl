// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_PIXELS
#define ESTAMPE_LAB_PIXELS

// The per-pixel work of the kernels that draw a page.

#include "lab.glsl"

// Work whose result is linear, so that it may be computed at vertices and interpolated. The result is x.

const uint at_corners = 1u;

float worked_on(float x)
{
    float y = 0.0;
    for (uint r = 0u; r < rounds; ++r) {
        y += 0.5 * (x - y);
    }
    return y;
}

// Copies a pixel, or computes it.

uint made_of(uint x)
{
    for (uint r = 0u; r < rounds; ++r) {
        x = stir(x);
    }
    return x;
}

// Only one in ten squares of `a` by `a` pixels has work to do.

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
