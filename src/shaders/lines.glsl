// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINES
#define ESTAMPE_LINES

// Dyadic line hatching: strokes are the iso-lines v = i S of a surface coordinate v, where the spacing S is a
// power of two of v's unit, chosen from the width on the page and the darkness t so that S t lies between one
// and two widths. Lines of the coarser spacing have the full width W, the ones between them W' = t S - W, so
// that the ink is exactly t at every distance and tilt, lines are only ever added on approach, and darker
// tone adds lines to those of lighter tone. The idea of nested strokes: Praun et al., "Real-Time Hatching",
// SIGGRAPH 2001.

#include "shaders/hash.glsl"

// A line or a cell boundary keeps its number at every zoom: i = odd * 2^level.
uint dyadic_identity(int i, int level, uint seed)
{
    int shift = max(findLSB(i), 0);
    uint number = i == 0 ? 0x5bd1e995u : uint(i >> shift) * 0x9e3779b1u ^ uint(level + shift) * 0x85ebca77u;
    return hash(number ^ seed);
}

// One of several independent numbers in [0, 1) that go with an identity.
float trait(uint identity, uint which)
{
    return unit_float(identity * (2u * which + 0x9e3779b1u) ^ (which * 0x632be5abu));
}

// A sine of period one, near enough: two parabolas.
float wave(float x)
{
    float y = x - round(x);
    return y * (8.0 - 16.0 * abs(y));
}

struct LineField {
    float v;        // across the strokes
    float v_per_px; // length of v's gradient on the page
    float u;        // along the strokes
    float u_per_px; // change of u over one pixel along the stroke
    vec2 wander;    // two coordinates that waver along the stroke, in u's unit: they drive the wobble
};

struct LineLook {
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    float cell_px;
    float pressure;
};

// What the lines of one family share at a pixel, worked out once.
struct LineScale {
    float wobble_frequency; // per unit of u, dyadic: a wavelength of about two cells
    float wobble_fade;      // towards twice that wavelength
    float wobble_px;
    float cell; // in u
    int cell_level;
    float cell_growth; // how far the boundaries halfway have opened
    float gap_scale;
};

LineScale scale_of(LineField field, LineLook look, float dark)
{
    LineScale scale;
    float u_per_px = max(field.u_per_px, 1e-6 * abs(field.u) + 1e-12);
    float octave = log2(1.6 * look.cell_px * u_per_px);
    scale.wobble_frequency = exp2(-floor(octave));
    scale.wobble_fade = fract(octave);
    // Ends and wobble give way as the paper fills up, so that the darkest tones can still be reached.
    scale.gap_scale = clamp(2.0 * (1.0 - dark), 0.0, 1.0);
    scale.wobble_px = min(look.wobble_px, 0.2 * look.width_px / dark * (1.0 - dark));
    float cells = log2(look.cell_px * u_per_px);
    scale.cell_level = int(ceil(cells));
    scale.cell = exp2(float(scale.cell_level));
    scale.cell_growth = exp2(float(scale.cell_level) - cells) - 1.0;
    return scale;
}

// Sideways displacement of a line in pixels: two octaves that cross-fade as the zoom changes.
float wobble(LineField field, LineScale scale, uint identity)
{
    float along = field.u + 0.35 * (field.wander.x + (2.0 * trait(identity, 1u) - 1.0) * field.wander.y);
    float phase = trait(identity, 2u);
    float fine = along * scale.wobble_frequency;
    float near = wave(fine + phase) + 0.3 * wave(2.618 * fine + 2.3 * phase);
    float far = wave(0.5 * fine + phase) + 0.3 * wave(1.309 * fine + 2.3 * phase);
    return scale.wobble_px * mix(near, far, scale.wobble_fade);
}

// Share of a line that is left, on average, after gaps and tapers. One boundary in four stays closed.
float kept_share(LineLook look, float gap_scale)
{
    return 1.0 - 0.75 * gap_scale * (look.gap_px + look.taper_px) / look.cell_px;
}

// Width factor along a line: 0 in gaps, rising over the taper. Cells are dyadic in u and as long as one to
// two cell_px; a boundary that appears on approach opens from nothing.
float stroke_profile(LineField field, LineLook look, LineScale scale, uint identity)
{
    float u = field.u + 16.0 * trait(identity, 3u);
    float half_cell = 0.5 * scale.cell;
    int nearest = int(round(u / half_cell));
    bool open = trait(dyadic_identity(nearest, scale.cell_level, identity), 4u) < 0.75;
    float opening = open ? scale.gap_scale * ((nearest & 1) == 0 ? 1.0 : scale.cell_growth) : 0.0;
    float distance_px = abs(u - float(nearest) * half_cell) / max(field.u_per_px, 1e-12);
    float rise =
        clamp((distance_px - 0.5 * look.gap_px * opening) / max(look.taper_px * opening, 1e-3), 0.0, 1.0);
    return opening > 0.0 ? rise * rise * (3.0 - 2.0 * rise) : 1.0;
}

float pressure_at(LineField field, LineLook look, LineScale scale, uint identity)
{
    return 1.0 + look.pressure * wave(0.7 * scale.wobble_frequency * field.u + trait(identity, 5u));
}

// Ink of one family of lines at a pixel whose darkness is `dark`, box-filtered over the pixel.
float line_ink(LineField field, LineLook look, float dark, uint seed)
{
    float g = max(field.v_per_px, 1e-12);
    LineScale scale = scale_of(field, look, max(dark, 1e-4));
    float t = clamp(dark / kept_share(look, scale.gap_scale), 1e-4, 1.0);
    float width = look.width_px * g;
    // Seen along its own plane a field does not change at all: spacing stays such that lines can be counted.
    int level = max(int(ceil(log2(width / t))), int(ceil(log2(max(abs(field.v), 1e-6)))) - 24);
    float spacing = exp2(float(level));
    float newborn = t * spacing - width;
    int first = int(floor(2.0 * field.v / spacing)) - 1;
    float ink = 0.0;
    for (int i = first; i < first + 4; ++i) {
        uint identity = dyadic_identity(i, level, seed);
        float line_width = ((i & 1) == 0 ? width : newborn) * stroke_profile(field, look, scale, identity) *
                           pressure_at(field, look, scale, identity);
        float at = 0.5 * float(i) * spacing + g * wobble(field, scale, identity);
        float low = max(at - 0.5 * line_width, field.v - 0.5 * g);
        float high = min(at + 0.5 * line_width, field.v + 0.5 * g);
        ink += max(high - low, 0.0) / g;
    }
    return dark > 0.0 ? min(ink, 1.0) : 0.0;
}

#endif
