// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LENS_INK
#define ESTAMPE_LENS_INK

// How ink changes out of focus: lines and strokes become wider and paler. The including shader must declare
// `constants`.

// Returns by how much the radius of a blur circle exceeds the radius of a sharp point, in pixels. `rest` is
// the last word of a packed texel.
float wider_by(uint rest)
{
    return max(abs(unpackHalf2x16(rest).x) - lens_sharp_px, 0.0);
}

float paled(float wider_px)
{
    return 1.0 / (1.0 + constants.paling_per_px * wider_px);
}

#endif
