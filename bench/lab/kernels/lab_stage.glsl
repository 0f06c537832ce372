// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_STAGE
#define ESTAMPE_LAB_STAGE

// A pixel that is copied, or worked on.

#include "lab.glsl"

uint made_of(uint x)
{
    for (uint r = 0u; r < rounds; ++r) {
        x = stir(x);
    }
    return x;
}

#endif
