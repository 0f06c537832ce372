// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_INK
#define ESTAMPE_LENS_INK

// What becomes of ink that is drawn out of focus. Whoever includes this has `constants`.

// By how much more than a point a circle blurs, of the last word of a packed texel.
float wider_by(uint rest)
{
    return max(abs(unpackHalf2x16(rest).x) - lens_sharp_px, 0.0);
}

float paled(float wider_px)
{
    return 1.0 / (1.0 + constants.paling_per_px * wider_px);
}

#endif
