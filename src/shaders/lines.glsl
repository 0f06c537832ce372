// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINES
#define ESTAMPE_LINES

// Dyadic line hatching: strokes are the iso-lines v = i S of a surface coordinate v, where the spacing S is a power of
// two of v's unit, chosen from the width on the page and the darkness t so that S t lies between one and two widths.
// Lines of the coarser spacing have the full width W, the ones between them W' = t S - W, so that the ink is exactly t at
// every distance and tilt, lines are only ever added on approach, and darker tone adds lines to those of lighter tone.
// The idea of nested strokes: Praun et al., "Real-Time Hatching", SIGGRAPH 2001.

#include "shaders/hash.glsl"

// A line or a cell boundary keeps its number at every zoom: i = odd * 2^level.
uint dyadic_identity(int i, int level, uint seed)
{
    if (i == 0) {
        return hash(0x9e3779b9u, seed);
    }
    int shift = findLSB(i);
    return hash(uint(i >> shift), uint(level + shift + 64), seed);
}

struct LineField {
    float v;          // across the strokes
    float v_per_px;   // length of v's gradient on the page
    float u;          // along the strokes
    float u_per_px;   // change of u over one pixel along the stroke
    vec2 wander;      // two coordinates that waver along the stroke, in u's unit: they drive the wobble
};

struct LineLook {
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    float cell_px;
    float pressure;
};

// Sideways displacement of a line in pixels: sines of a dyadic wavelength that stays near 100 px on the page, two
// octaves cross-fading as the zoom changes.
float wobble(LineField field, uint identity, float amplitude_px)
{
    float octave = log2(96.0 * max(field.u_per_px, 1e-12));
    float base = floor(octave);
    float fade = octave - base;
    float phase = 6.2831853 * unit_float(identity);
    float lean = unit_float(hash(identity, 3u)) * 2.0 - 1.0;
    float along = field.u + 0.35 * (field.wander.x + lean * field.wander.y);
    float fine = 6.2831853 * along * exp2(-base);
    float near = sin(fine + phase) + 0.45 * sin(2.618 * fine + 2.3 * phase);
    float far = sin(0.5 * fine + phase) + 0.45 * sin(1.309 * fine + 2.3 * phase);
    return 0.7 * amplitude_px * mix(near, far, fade);
}

// Expected share of a line that is left after gaps and tapers.
float kept_share(LineLook look, float gap_scale)
{
    return 1.0 - 0.75 * gap_scale * (look.gap_px + look.taper_px) / look.cell_px;
}

// Width factor along a line: 0 in gaps, rising over the taper. Cells are dyadic in u and as long as one to two cell_px;
// a boundary that appears on approach opens from nothing. One boundary in four stays closed, so lengths differ.
float stroke_profile(LineField field, LineLook look, uint identity, float gap_scale)
{
    float u = field.u + 16.0 * unit_float(hash(identity, 7u));
    float level = ceil(log2(look.cell_px * max(field.u_per_px, 1e-12)));
    float cell = exp2(level);
    float growth = clamp(cell / (look.cell_px * field.u_per_px) - 1.0, 0.0, 1.0);
    int nearest = int(round(2.0 * u / cell));
    float profile = 1.0;
    for (int i = nearest - 1; i <= nearest + 1; ++i) {
        bool open = unit_float(dyadic_identity(i, int(level) - 1, identity)) < 0.75;
        float scale = ((i & 1) == 0 ? 1.0 : growth) * gap_scale * (open ? 1.0 : 0.0);
        float distance_px = abs(u - 0.5 * float(i) * cell) / field.u_per_px;
        float taper = look.taper_px * scale;
        profile = min(profile, scale > 0.0 ? smoothstep(0.0, 1.0, (distance_px - 0.5 * look.gap_px * scale) / max(taper, 1e-3)) : 1.0);
    }
    return profile;
}

float pressure_at(LineField field, LineLook look, uint identity)
{
    float along = field.u * exp2(-floor(log2(170.0 * max(field.u_per_px, 1e-12))));
    return 1.0 + look.pressure * sin(6.2831853 * (along + unit_float(hash(identity, 11u))));
}

// Ink of one family of lines at a pixel whose darkness is `dark`, box-filtered over the pixel.
float line_ink(LineField field, LineLook look, float dark, uint seed)
{
    if (dark <= 0.0) {
        return 0.0;
    }
    float g = max(field.v_per_px, 1e-12);
    // Ends and wobble give way as the paper fills up, so that the darkest tones can still be reached.
    float gap_scale = clamp(2.0 * (1.0 - dark), 0.0, 1.0);
    float t = min(dark / kept_share(look, gap_scale), 1.0);
    float width = look.width_px * g;
    float level = ceil(log2(width / t));
    float spacing = exp2(level);
    float newborn = t * spacing - width;
    float amplitude = min(look.wobble_px, 0.2 * look.width_px / t * (1.0 - dark));
    int nearest = int(round(2.0 * field.v / spacing));
    float ink = 0.0;
    for (int i = nearest - 2; i <= nearest + 2; ++i) {
        uint identity = dyadic_identity(i, int(level) - 1, seed);
        float line_width = (i & 1) == 0 ? width : newborn;
        float at = 0.5 * float(i) * spacing + g * wobble(field, identity, amplitude);
        float reach = abs(field.v - at) - 0.5 * g;
        if (reach > 0.7 * line_width) {
            continue;
        }
        line_width *= stroke_profile(field, look, identity, gap_scale) * pressure_at(field, look, identity);
        float low = max(at - 0.5 * line_width, field.v - 0.5 * g);
        float high = min(at + 0.5 * line_width, field.v + 0.5 * g);
        ink += max(high - low, 0.0) / g;
    }
    return min(ink, 1.0);
}

#endif
