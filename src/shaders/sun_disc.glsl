// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_DISC
#define ESTAMPE_SUN_DISC

// What is seen of the sun, a disc, above a straight horizon.

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

#endif
