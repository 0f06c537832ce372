// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SPIRAL
#define ESTAMPE_SPIRAL

// The i-th of a spiral of points that fill the unit disc (Vogel 1979): evenly for a power of a half, denser
// about the middle for larger ones.
vec2 spiral(uint i, uint count, float power)
{
    float radius = pow((float(i) + 0.5) / float(count), power);
    float angle = 2.3999632 * float(i);
    return radius * vec2(cos(angle), sin(angle));
}

#endif
