// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_LIST
#define ESTAMPE_SAMPLE_LIST

// Samples of a chain by their index in the chain.

struct ChainOfSamples {
    uint first;
    uint steps; // number of samples minus one
    bool is_closed;
};

// Index of a sample that may lie beyond the end: clamped, or wrapped around in a closed chain.
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
