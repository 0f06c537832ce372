// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_NOISE
#define ESTAMPE_NOISE

#include "shaders/hash.glsl"

float lattice_value(ivec2 cell, uint seed)
{
    return unit_float(hash(uint(cell.x) * 0x9e3779b1u ^ uint(cell.y) * 0x85ebca77u ^ seed * 0xc2b2ae3du));
}

// Value noise in [0, 1] with one bump per unit of `p` and continuous first derivatives.
float value_noise(vec2 p, uint seed)
{
    ivec2 cell = ivec2(floor(p));
    vec2 f = p - vec2(cell);
    f = f * f * (3.0 - 2.0 * f);
    float bottom = mix(lattice_value(cell, seed), lattice_value(cell + ivec2(1, 0), seed), f.x);
    float top = mix(lattice_value(cell + ivec2(0, 1), seed), lattice_value(cell + ivec2(1, 1), seed), f.x);
    return mix(bottom, top, f.y);
}

#endif
