// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB
#define ESTAMPE_LAB

// Functions of all kernels of the laboratory. kernels.hpp has C++ versions of them, with which the CPU checks
// the kernels' output.

layout(push_constant, scalar) uniform Constants
{
    uint threads;
    uint rounds;
    uint a;
    uint b;
};

// Work that no compiler can shorten: each step needs the previous step's result, and two steps cannot be
// combined.
uint stir(uint x)
{
    return (x ^ (x >> 15)) * 0x2c1b3c6du + 0x297a2d39u;
}

uint stir_otherwise(uint x)
{
    return (x ^ (x >> 13)) * 0x9e3779b1u + 0x85ebca6bu;
}

// A number that is unrelated to the number of a neighbouring thread.
uint scattered(uint x)
{
    return stir_otherwise(stir(stir_otherwise(x)));
}

// Repeated calls visit all numbers below a power of two once.
uint next_of(uint x)
{
    return x * 1664525u + 1013904223u;
}

#endif
