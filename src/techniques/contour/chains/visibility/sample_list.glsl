// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SAMPLE_LIST
#define ESTAMPE_SAMPLE_LIST

// Samples of a chain by their place in it. Wanted before: `samples`, and the slots of slots.glsl.

struct ChainOfSamples {
    uint first;
    uint steps; // one less than its samples
    bool is_closed;
};

// Place of a sample that lies beyond the end: that of the end, or around a closed chain.
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
