// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_LIST
#define ESTAMPE_SAMPLE_LIST

// Functions that read the line samples of a chain by the samples' index in the chain.

struct ChainOfSamples {
    uint first;
    uint steps; // number of steps between the samples of the chain
    bool is_closed;
};

// Index in the sample list of sample number `place` of a chain. Sample numbers beyond the chain's ends are
// clamped; in a closed chain, the numbers wrap around.
uint place_in(ChainOfSamples chain, int place)
{
    int steps = int(chain.steps);
    return uint(chain.is_closed ? (place + 2 * steps) % steps : clamp(place, 0, steps));
}

float spacing_of(uint state)
{
    return unpackHalf2x16(state).y;
}

#endif
