// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HASH
#define ESTAMPE_HASH

// Integer hash with O'Neill's PCG output permutation, from Jarzynski and Olano, "Hash Functions for GPU
// Rendering", JCGT 2020.

uint hash(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uint hash(uint x, uint y)
{
    return hash(x ^ hash(y));
}

uint hash(uint x, uint y, uint z)
{
    return hash(x ^ hash(y ^ hash(z)));
}

// Uniform random number in [0, 1) from the top 24 bits of a hash.
float unit_float(uint bits)
{
    return float(bits >> 8u) * (1.0f / 16777216.0f);
}

#endif
