// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_GRID
#define ESTAMPE_LAB_GRID

// Work whose outcome is linear, so that it may be done at corners and interpolated: it comes to x in the end.

#include "lab.glsl"

const uint at_corners = 1u;

float worked_on(float x)
{
    float y = 0.0;
    for (uint r = 0u; r < rounds; ++r) {
        y += 0.5 * (x - y);
    }
    return y;
}

#endif
