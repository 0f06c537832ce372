// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TEETH
#define ESTAMPE_TEETH

// The curve of a toothed shadow edge over the coordinate v across the hatching lines: one tooth (small
// stroke) per line.

#include "shaders/lines.glsl"

// Length, up to 1, of the tooth (small stroke) of one hatching line at a shadow edge.
float tooth_length(LineField field, Lines lines, int number, uint seed, float variety)
{
    return 1.0f - variety * trait(line_identity(field, lines, number, seed), 8u);
}

// Curve of shadow edge teeth (small strokes) on hatching lines that are `stride` half spacings apart: a
// cosine with its maxima on the lines. Each maximum is as high as its line's tooth. Between two lines the
// cosine is as deep as the mean height of the two teeth, so that the area added to the shadow equals the area
// removed.
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

// Displacement of a shadow edge by its teeth, -1 to 1, with mean 0; positive on hatching lines, which have
// the given width and darkness. As the eye comes nearer, new teeth (small strokes) grow between the old
// teeth, as new hatching strokes do.
float tooth(LineField field, uint seed, float width_px, float darkness, float variety)
{
    Lines lines = lines_of(field, width_px, darkness);
    float grown = lines.newborn * lines.newborn * (3.0f - 2.0f * lines.newborn);
    return mix(comb(field, lines, 2, seed, variety), comb(field, lines, 1, seed, variety), grown);
}

#endif
