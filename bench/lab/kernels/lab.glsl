// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB
#define ESTAMPE_LAB

// What all kernels of the laboratory share. kernels.hpp has the same functions for the processor, which
// checks by them.

layout(push_constant, scalar) uniform Constants
{
    uint threads;
    uint rounds;
    uint a;
    uint b;
};

// Work that no compiler makes shorter: each step needs the one before, and two do not fold into one.
uint stir(uint x)
{
    return (x ^ (x >> 15)) * 0x2c1b3c6du + 0x297a2d39u;
}

uint stir_otherwise(uint x)
{
    return (x ^ (x >> 13)) * 0x9e3779b1u + 0x85ebca6bu;
}

// A number that has nothing to do with its neighbour's.
uint scattered(uint x)
{
    return stir_otherwise(stir(stir_otherwise(x)));
}

// Runs once through all numbers below a power of two.
uint next_of(uint x)
{
    return x * 1664525u + 1013904223u;
}

#endif
