// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TEETH
#define ESTAMPE_TEETH

// The curve that the edge of a shadow follows, over a coordinate v: a tooth on each line of the hatching.

#include "shaders/lines.glsl"

// How long the tooth of a line is, up to 1.
float tooth_length(LineField field, Lines lines, int number, uint seed, float variety)
{
    return 1.0f - variety * trait(line_identity(field, lines, number, seed), 8u);
}

// Teeth on lines that are `stride` halves of the spacing apart: a cosine that is highest on the lines, as
// long as each line's own tooth; between two lines it falls as deep as their mean, so that what is added is
// what is taken away.
float comb(LineField field, Lines lines, int stride, uint seed, float variety)
{
    float x = 2.0f * field.v / (lines.spacing * float(stride));
    float nearest = round(x);
    float phase = x - nearest;
    int number = int(nearest) * stride;
    float own = tooth_length(field, lines, number, seed, variety);
    float other = tooth_length(field, lines, number + (phase < 0.0f ? -stride : stride), seed, variety);
    float height = cos(6.2831853f * phase);
    return height * (height > 0.0f ? own : 0.5f * (own + other));
}

// How far the edge is moved, -1 to 1, mean 0; above 0 on the lines of that width and darkness. As one comes
// nearer, new teeth grow between the old ones, as the strokes do.
float tooth(LineField field, uint seed, float width_px, float darkness, float variety)
{
    Lines lines = lines_of(field, width_px, darkness);
    float grown = lines.newborn * lines.newborn * (3.0f - 2.0f * lines.newborn);
    return mix(comb(field, lines, 2, seed, variety), comb(field, lines, 1, seed, variety), grown);
}

#endif
