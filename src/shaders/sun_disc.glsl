// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_DISC
#define ESTAMPE_SUN_DISC

// Lights with the shape of a disc, mainly the sun: the visible share of a disc above a straight horizon, and
// sample points on a disc.

// Angle from the sun's centre up to a horizon with this slope. The formula is also precise for small angles.
float above_sun_rad(float horizon_slope, float cos_elevation, float sin_elevation)
{
    return atan(horizon_slope * cos_elevation - sin_elevation, cos_elevation + horizon_slope * sin_elevation);
}

// Visible share of a disc above a horizon that is `x` radii above the disc's centre: 1 at -1, 0 at 1.
float share_of_disc(float x)
{
    if (x < -0.999) {
        return 1.0; // exactly 1, without a rounding error
    }
    float h = min(x, 1.0);
    float width = sqrt(1.0 - h * h);
    return (atan(width, h) - h * width) / 3.14159265;
}

// The i-th point of a spiral that fills the unit disc (Vogel 1979). A power of 0.5 gives a uniform density;
// larger powers are denser around the centre.
vec2 spiral(uint i, uint count, float power)
{
    float radius = pow((float(i) + 0.5) / float(count), power);
    float angle = 2.3999632 * float(i);
    return radius * vec2(cos(angle), sin(angle));
}

#endif
