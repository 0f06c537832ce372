// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINES
#define ESTAMPE_LINES

#include "shaders/hash.glsl"

// Dyadic line hatching: strokes are iso-lines of a surface coordinate v, at whole multiples of a spacing. The
// spacing is a power of two in the unit of v. The spacing is chosen from the stroke width on the page and the
// darkness, so that spacing times darkness lies between one and two stroke widths. Lines of the coarser
// spacing (old lines) have the full stroke width. Lines between old lines (newborn lines) have the remaining
// ink: spacing times darkness, less the stroke width. The ink therefore equals the darkness at every distance
// and tilt. Coming nearer only adds lines, as does a darker tone. Nested strokes are from Praun et al.,
// "Real-Time Hatching", SIGGRAPH 2001.

// Powers of two by bit operations, for an argument x above 0: exact, and much cheaper than the GLSL functions
// exp2 and log2.
float power_of_two(int exponent)
{
    return intBitsToFloat((exponent + 127) << 23);
}

int floor_log2(float x)
{
    return (floatBitsToInt(x) >> 23) - 127;
}

int ceil_log2(float x)
{
    return ((floatBitsToInt(x) + 0x7fffff) >> 23) - 127;
}

// Random identity of the line or cell boundary with the number i, which is an odd number times a power of
// two. The identity stays unchanged at every zoom.
uint dyadic_identity(int i, int level, uint seed)
{
    // The exponent of the lowest set bit of the line number i, read from the float representation of that
    // bit.
    int shift = (floatBitsToInt(float(i & -i)) >> 23) - 127;
    uint number =
        i == 0 ? 0x5bd1e995u : uint(i >> (shift & 31)) * 0x9e3779b1u ^ uint(level + shift) * 0x85ebca77u;
    return hash(number ^ seed);
}

// Number that stands for a line and all equivalent lines, for a coordinate that is only known up to integers
// and sign. The argument `i` is the line's index among `count` lines per unit; `count` is a power of two.
int folded(int i, int count)
{
    int inside = ((i - 1) & (count - 1)) + 1;
    return inside == count ? count : min(inside, count - inside);
}

// A random number from 0 to 1, made from a line's identity; one line can have several independent random
// numbers.
float trait(uint identity, uint which)
{
    return unit_float(identity * (2u * which + 0x9e3779b1u) ^ (which * 0x632be5abu));
}

// Approximate sine with the period 1, from two parabolas.
float wave(float x)
{
    float y = x - round(x);
    return y * (8.0f - 16.0f * abs(y));
}

// Smooth step from 0 to 1 where the argument x is 0; `breadth` is the width of the transition.
float soft_step(float x, float breadth)
{
    float y = clamp(x / max(breadth, 1e-3f) + 0.5f, 0.0f, 1.0f);
    return y * y * (3.0f - 2.0f * y);
}

struct LineField {
    float v;        // coordinate across the strokes, whose iso-lines are the strokes
    float v_per_px; // length of the gradient of the coordinate v, per pixel
    float u;        // coordinate along the strokes
    float u_per_px; // change of the coordinate u per pixel along the stroke
    vec2 wander;    // two coordinates along the stroke, in the unit of u, for the strokes' wobble
    bool wraps;     // the coordinates v and u are only known up to integers and sign
};

struct HatchLineStyle {
    float width_px;
    float wobble_px;
    float gap_px;
    float taper_px;
    float cell_px;
    float pressure;
    // Form in which newborn lines (between two old lines) get their ink: 0 thin along their whole length, 1
    // as short strokes of full width.
    float growth;
};

// The hatching lines of one family (a set of parallel lines) near a pixel. Line numbers count half spacings:
// even lines are old (of the coarser spacing), odd lines newborn (between them).
struct Lines {
    int level; // logarithm to base 2 of the lines' spacing
    float spacing;
    float width;   // width of an old line (of the coarser spacing), in the unit of v
    float newborn; // ink of a newborn line (between two old lines) as a share of an old line's ink, 0 to 1
};

// Spacing and width of the lines at a pixel. `darkness` in (0, 1] is the coverage of lines without gaps.
Lines lines_of(LineField field, float width_px, float darkness)
{
    Lines lines;
    lines.width = width_px * max(field.v_per_px, 1e-12f);
    // On a surface seen edge-on, the coordinate v across the strokes is constant on the page. The spacing is
    // therefore limited, to keep line numbers countable.
    lines.level = max(ceil_log2(lines.width / darkness), ceil_log2(max(abs(field.v), 1e-6f)) - 24);
    lines.level = field.wraps ? min(lines.level, 0) : lines.level;
    lines.spacing = power_of_two(lines.level);
    float owed = darkness * lines.spacing;
    lines.width = min(lines.width, owed);
    lines.newborn = clamp(owed / lines.width - 1.0f, 0.0f, 1.0f);
    return lines;
}

uint line_identity(LineField field, Lines lines, int number, uint seed)
{
    // Number of lines per unit of v (the coordinate across the strokes): 2 / spacing.
    int count = 1 << clamp(1 - lines.level, 0, 30);
    return dyadic_identity(field.wraps ? folded(number, count) : number, lines.level, seed);
}

// Values that the hatching lines of one family (a set of parallel lines) share at a pixel.
struct LineScale {
    // Cells of the wobble per unit of u (the coordinate along the strokes), a power of two. A wave is about
    // two cells long.
    float wobble_frequency;
    float wobble_fade; // share of the blend towards twice the wobble's wavelength
    float wobble_px;
    float pressure;
    float cell; // length of a cell (a piece of a line between two gaps), in the coordinate u
    int cell_level;
    float cell_growth; // degree to which the gaps at half cells are open
    float gap_scale;
    float px_per_u;
};

LineScale scale_of(LineField field, HatchLineStyle style, float dark)
{
    LineScale scale;
    float u_per_px = max(field.u_per_px, 1e-6f * abs(field.u) + 1e-12f);
    float wavelength = 1.6f * style.cell_px * u_per_px;
    wavelength = field.wraps ? min(wavelength, 0.5f) : wavelength;
    scale.wobble_frequency = power_of_two(-floor_log2(wavelength));
    scale.wobble_fade = log2(wavelength * scale.wobble_frequency);
    // Gaps, wobble and pressure fade as the paper fills up, because lines that touch would lose ink.
    scale.gap_scale = clamp(2.0f * (1.0f - dark), 0.0f, 1.0f);
    scale.wobble_px = min(style.wobble_px, 0.17f * style.width_px / dark * (1.0f - dark));
    scale.pressure = min(style.pressure, 0.5f * (1.0f - dark) / dark);
    float cell = style.cell_px * u_per_px;
    cell = field.wraps ? min(cell, 1.0f) : cell;
    scale.cell_level = ceil_log2(cell);
    scale.cell = power_of_two(scale.cell_level);
    scale.cell_growth = scale.cell / cell - 1.0f;
    scale.px_per_u = 1.0f / max(field.u_per_px, 1e-12f);
    return scale;
}

// Sideways displacement of a hatching line in pixels: two octaves that cross-fade as the zoom changes.
float wobble(LineField field, LineScale scale, uint identity)
{
    float along = field.u + 0.35f * (field.wander.x + (2.0f * trait(identity, 1u) - 1.0f) * field.wander.y);
    float phase = trait(identity, 2u);
    float fine = along * scale.wobble_frequency;
    return 1.15f * scale.wobble_px * mix(wave(fine + phase), wave(0.5f * fine + phase), scale.wobble_fade);
}

// Mean opening of the gaps at cell boundaries, as a share of the largest opening. One in four cell boundaries
// has no gap. 0 if the lines have no gaps.
float mean_opening(HatchLineStyle style, float gap_scale)
{
    return style.gap_px > 0.0f ? 0.75f * gap_scale : 0.0f;
}

// Mean share of a hatching line that remains after gaps and tapers.
float kept_share(HatchLineStyle style, float gap_scale)
{
    return 1.0f - mean_opening(style, gap_scale) * (style.gap_px + style.taper_px) / style.cell_px;
}

// Width factor along a hatching line: 0 in gaps, rising to 1 over the taper. The line is divided along the
// coordinate u into cells with gaps between the cells. The length of a cell is a power of two in u, and one
// to two times `cell_px` on the page. In darker tones and with distance, gaps shrink to a third and then
// close one after another. Each gap of a line closes almost suddenly, because a nearly closed gap would be a
// white speck.
float stroke_profile(LineField field, HatchLineStyle style, LineScale scale, uint identity)
{
    float u = field.u + 16.0f * trait(identity, 3u);
    float half_cell = 0.5f * scale.cell;
    int nearest = int(round(u * (1.0f / half_cell)));
    int count = 1 << clamp(1 - scale.cell_level, 0, 30);
    uint boundary = dyadic_identity(field.wraps ? ((nearest - 1) & (count - 1)) + 1 : nearest,
                                    scale.cell_level, identity);
    const float least = 0.35f;
    const float haste = 16.0f;
    float wanted = mean_opening(style, scale.gap_scale) * ((nearest & 1) == 0 ? 1.0f : scale.cell_growth);
    float size = max(wanted / 0.75f, least);
    float opening = size * clamp((wanted / size - trait(boundary, 4u)) * haste + 0.5f, 0.0f, 1.0f);
    opening = wanted > 0.0f ? opening : 0.0f;
    float distance_px = abs(u - float(nearest) * half_cell) * scale.px_per_u;
    float taper_px = style.taper_px * opening;
    return opening > 0.0f ? soft_step(distance_px - 0.5f * (style.gap_px * opening + taper_px), taper_px)
                          : 1.0f;
}

// Width factor along a newborn line (between two old lines) with `share` of its ink, drawn as strokes that
// grow one after another: 0 or 1 with soft ends. The strokes keep their places along the line while the line
// is newborn.
float grown_profile(LineField field, HatchLineStyle style, Lines lines, uint identity, float share)
{
    const float spread = 0.5f; // share of the growth during which a single stroke grows
    float cell = 4.0f * lines.spacing;
    float at = field.u / cell + trait(identity, 6u);
    float number = floor(at);
    float order = trait(hash(identity ^ uint(int(number)) * 0x9e3779b1u), 7u);
    // The strokes' lengths are chosen such that their mean over all orders from 0 to 1 is `share`.
    float front = share < 0.5f * spread          ? sqrt(2.0f * spread * share)
                  : share < 1.0f - 0.5f * spread ? share + 0.5f * spread
                                                 : 1.0f + spread - sqrt(2.0f * spread * (1.0f - share));
    float length_here = clamp((front - order) / spread, 0.0f, 1.0f);
    float px_per_cell = cell / max(field.u_per_px, 1e-12f);
    float inside_px = (0.5f * length_here - abs(at - number - 0.5f)) * px_per_cell;
    float soft_px = min(style.taper_px, min(length_here, 1.0f - length_here) * px_per_cell);
    return length_here > 0.0f ? soft_step(inside_px, soft_px) : 0.0f;
}

float pressure_at(LineField field, LineScale scale, uint identity)
{
    return 1.0f + scale.pressure * wave(scale.wobble_frequency * field.u + trait(identity, 5u));
}

// The hatching lines of one family (a set of parallel lines) near a pixel, as they are drawn.
struct DrawnLines {
    Lines lines;
    LineScale scale;
    float newborn_length; // drawn share of the length of a newborn line (between two old lines)
    float newborn_width;
};

// Computes the lines to draw. `dark` is the darkness that the family of lines must reach.
DrawnLines drawn_lines(LineField field, HatchLineStyle style, float dark)
{
    DrawnLines drawn;
    drawn.scale = scale_of(field, style, max(dark, 1e-4f));
    float wanted = clamp(dark / kept_share(style, drawn.scale.gap_scale), 1e-4f, 1.0f);
    drawn.lines = lines_of(field, style.width_px, wanted);
    drawn.newborn_length = 1.0f;
    drawn.newborn_width = drawn.lines.width * drawn.lines.newborn;
    if (style.growth > 0.0f) {
        // The width of newborn strokes (between old lines) is limited so that they do not touch the old
        // lines.
        float room = 0.7f * (drawn.lines.spacing - drawn.lines.width) / drawn.lines.width;
        float share = max(pow(drawn.lines.newborn, style.growth), drawn.lines.newborn / room);
        drawn.newborn_length = clamp(share, 1e-6f, 1.0f);
        drawn.newborn_width /= drawn.newborn_length;
    }
    return drawn;
}

// Width of hatching line number i at the pixel, in the unit of v (the coordinate across the strokes).
float drawn_width(LineField field, HatchLineStyle style, DrawnLines drawn, int i, uint identity)
{
    bool is_old = (i & 1) == 0;
    float profile =
        stroke_profile(field, style, drawn.scale, identity) * pressure_at(field, drawn.scale, identity);
    if (!is_old && style.growth > 0.0f) {
        profile *= grown_profile(field, style, drawn.lines, identity, drawn.newborn_length);
    }
    return (is_old ? drawn.lines.width : drawn.newborn_width) * profile;
}

// Ink of one family of (parallel) hatching lines at a pixel of darkness `dark`, box-filtered over the pixel.
float line_ink(LineField field, HatchLineStyle style, float dark, uint seed)
{
    float g = max(field.v_per_px, 1e-12f);
    DrawnLines drawn = drawn_lines(field, style, dark);
    // Half the range of the coordinate v within which lines may touch the pixel. The range has at most four
    // lines, because lines keep their distance.
    float reach =
        0.5f * drawn.lines.width * (1.0f + drawn.scale.pressure) + g * (1.15f * drawn.scale.wobble_px + 0.5f);
    int first = int(ceil(2.0f * (field.v - reach) / drawn.lines.spacing));
    int last = min(int(floor(2.0f * (field.v + reach) / drawn.lines.spacing)), first + 3);
    float ink = 0.0f;
    for (int i = first;; ++i) {
        uint identity = line_identity(field, drawn.lines, i, seed);
        float width = drawn_width(field, style, drawn, i, identity);
        float at = 0.5f * float(i) * drawn.lines.spacing + g * wobble(field, drawn.scale, identity);
        float low = max(at - 0.5f * width, field.v - 0.5f * g);
        float high = min(at + 0.5f * width, field.v + 0.5f * g);
        ink += i <= last ? max(high - low, 0.0f) : 0.0f;
        if (i >= last) {
            break;
        }
    }
    return dark > 0.0f ? min(ink / g, 1.0f) : 0.0f;
}

#endif
