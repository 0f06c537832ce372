// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_SURPLUS
#define ESTAMPE_FLUID_SURPLUS

// Factor on the confinement of a swirl: 1 + `surplus` for slow swirls, and 1 for swirls of the vorticity
// `swirl_most`. Faster swirls get less still, down to nothing, because the path of a step could not follow
// them if they got faster.
float fed_by_surplus(float vorticity, float surplus, float swirl_most)
{
    float share = vorticity / swirl_most;
    return max(1.0 + surplus * (1.0 - share * share), 0.0);
}

#endif
