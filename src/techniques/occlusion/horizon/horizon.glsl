// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HORIZON
#define ESTAMPE_HORIZON

// Angles in a slice (plane through the view ray): 0 is towards the eye, positive angles are on the sampled
// side. The hemisphere above the surface is divided into sectors of equal light.

const uint horizon_sectors = 32u;

// Ambient light in a slice (plane through the view ray) from angle 0 to `angle`, given by the cosine and sine
// of `angle`. The surface's normal leans by an angle n with cosine `cos_n` and sine `sin_n`. The light is the
// integral of cos(a - n) sin(a) over all angles a from 0 to `angle`.
float slice_light(float angle, float cosine, float sine, float cos_n, float sin_n)
{
    float cos_double = (2.0f * cosine * cosine - 1.0f) * cos_n + 2.0f * sine * cosine * sin_n;
    return 0.25f * (cos_n - cos_double + 2.0f * angle * sin_n);
}

// Ambient light in a slice (plane through the view ray) from angle 0 to the surface's horizon, which is pi /
// 2 from the surface's normal.
float slice_light_whole(float n, float cos_n, float sin_n)
{
    return 0.25f * (2.0f * cos_n + (3.14159265f + 2.0f * n) * sin_n);
}

// Bit mask of the sectors whose middles lie between two positions of the hemisphere, 0 to 1. `shift` moves
// the middles by less than half a sector.
uint sectors_between(float low, float high, float shift)
{
    int first = int(clamp(low, 0.0f, 1.0f) * float(horizon_sectors) + 0.5f + shift);
    int end = int(clamp(high, 0.0f, 1.0f) * float(horizon_sectors) + 0.5f + shift);
    int count = clamp(end - first, 0, 31);
    uint bits = ((1u << uint(count)) - 1u) << uint(min(first, 31));
    return end - first > 31 ? 0xffffffffu : bits;
}

#endif
