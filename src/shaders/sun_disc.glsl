// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_DISC
#define ESTAMPE_SUN_DISC

// Lights that are discs, the sun foremost: what is seen of one above a straight horizon, and points that fill
// it.

// The angle from the sun's centre up to a horizon of that slope. Exact also where it is small.
float above_sun_rad(float horizon_slope, float cos_elevation, float sin_elevation)
{
    return atan(horizon_slope * cos_elevation - sin_elevation, cos_elevation + horizon_slope * sin_elevation);
}

// Share of a disc above a horizon `x` radii above its centre: 1 at -1, 0 at 1.
float share_of_disc(float x)
{
    if (x < -0.999) {
        return 1.0; // and not a rounding less
    }
    float h = min(x, 1.0);
    float width = sqrt(1.0 - h * h);
    return (atan(width, h) - h * width) / 3.14159265;
}

// The i-th of a spiral of points that fill the unit disc (Vogel 1979): evenly for a power of a half, denser
// about the middle for larger ones.
vec2 spiral(uint i, uint count, float power)
{
    float radius = pow((float(i) + 0.5) / float(count), power);
    float angle = 2.3999632 * float(i);
    return radius * vec2(cos(angle), sin(angle));
}

#endif
