// SPDX-License-Identifier: MIT
// One thread handles one pixel. The thread finds where the centre lines of strokes pass between the pixel and
// the pixels to the right and below. The method is marching squares, with one contour value per line. Each
// crossing stores the drawn width of the line. Where the surface ends between two pixels, both sides are
// extended by half a pixel. The crossings are listed in any order.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/lines.glsl"
#include "shaders/unit.glsl"
#include "shaders/stroke_field.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform usampler2D normal_image;
layout(binding = 3) uniform sampler2D coordinate_image;
layout(binding = 4) uniform usampler2D footprint_image;
// For each pixel: the pixel whose strokes extend into the first pixel, see overrun.comp.
layout(binding = 5) uniform usampler2D source_image;
// Packed direction towards the strongest local light; 0 for none.
layout(binding = 6) uniform usampler2D strongest_image;

layout(scalar, binding = 7) buffer Crossings
{
    uint crossing_count; // number of all crossings, including crossings for which the list has no room
    Crossing crossings[];
};

layout(push_constant, scalar) uniform Constants
{
    LineConstants constants;
};

#include "techniques/hatch/line_families.glsl"
#include "techniques/hatch/loose_ends.glsl"

#define OVERRUN_PX constants.overrun_px
#include "techniques/hatch/overrun_source.glsl"

const float least_width_px = 0.04;
const int most_lines = 64; // largest number of lines between two neighbouring pixels
const uint most_families = 6u;

// The values that determine the strokes at one pixel.
struct Spot {
    ivec2 source; // pixel from which all other values are
    uint word;
    vec3 p;
    Footprint f;
    vec3 normal;
    vec3 towards_light;
    float dark;
    float share; // part of the source's darkness that is drawn here
};

Spot spot_at(ivec2 pixel)
{
    float share;
    ivec2 source = source_of(pixel, share);
    vec2 beyond = vec2(pixel - source);
    Spot spot;
    spot.source = source;
    spot.share = share;
    spot.word = texelFetch(draw_image, source, 0).x;
    spot.f = unpack_footprint(texelFetch(footprint_image, source, 0));
    spot.p = texelFetch(coordinate_image, source, 0).xyz + spot.f.dx * beyond.x + spot.f.dy * beyond.y;
    spot.normal = unpack_normal(texelFetch(normal_image, source, 0).y);
    spot.towards_light = towards_light_of(has_local_light ? texelFetch(strongest_image, source, 0).x : 0u);
    spot.dark = sees_draw(spot.word) ? texelFetch(darkness_image, source, 0).x * share : 0.0;
    return spot;
}

void darkness_of_families(Spot spot, out float dark[most_families])
{
    for (uint i = 0u; i < most_families; ++i) {
        dark[i] = 0.0;
    }
    towards_light = spot.towards_light;
    if (has_loose_ends) {
        for (uint family = 0u; family < 2u * constants.layers && sees_draw(spot.word); ++family) {
            dark[family] =
                spot.share * family_darkness(spot.source, spot.p, spot.f, spot.normal, spot.word, family);
        }
        return;
    }
    Families families = Families(0u, false, spot.dark);
    while (is_any_left(families)) {
        uint family;
        float family_dark = next_family(families, spot.normal, strokes_of(spot.word), family);
        dark[family] = family_dark;
    }
}

// Maps the stroke coordinates of one pixel to the stroke coordinates of a neighbour. Only strokes along the
// form (the curvature of the surface) need the mapping, because their coordinates are defined only up to
// whole numbers and sign.
struct Turn {
    float sign;
    vec3 shift;
};

// Whether the surface continues from pixel `a` to pixel `b`: the stroke coordinate must change as the
// footprints of both pixels predict.
bool goes_on(Spot a, Spot b, bool is_down, out Turn turn)
{
    bool wraps = has_form && strokes_of(a.word) == strokes_form;
    turn.sign = wraps && dot(a.f.dx, b.f.dx) + dot(a.f.dy, b.f.dy) < 0.0 ? -1.0 : 1.0;
    vec3 step_a = is_down ? a.f.dy : a.f.dx;
    vec3 step_b = turn.sign * (is_down ? b.f.dy : b.f.dx);
    vec3 foretold = a.p + 0.5 * (step_a + step_b);
    turn.shift = wraps ? round(foretold - turn.sign * b.p) : vec3(0.0);
    vec3 surprise = foretold - (turn.sign * b.p + turn.shift);
    float size = max(max(length(a.f.dx), length(a.f.dy)), max(length(b.f.dx), length(b.f.dy)));
    float allowed = 0.5 * length(step_a - step_b) + 0.15 * size;
    return a.word == b.word && a.towards_light == b.towards_light &&
           dot(surprise, surprise) < allowed * allowed;
}

// Width in pixels of the line at the stroke coordinate number / 2 * 2^level, from the parameters `number` and
// `level`; 0 if the pixel does not draw the line.
float width_at(LineField field, HatchLineStyle style, DrawnLines drawn, float dark, int number, int level,
               uint identity)
{
    int above = drawn.lines.level - level;
    bool is_there = dark > 0.0 && above < 31 && (number & ((1 << (above & 31)) - 1)) == 0;
    float width = drawn_width(field, style, drawn, number >> (above & 31), identity);
    return is_there ? width / max(field.v_per_px, 1e-12) : 0.0;
}

void list(uint edge, uint word, uint family, int number, int exponent, float along, float width_px)
{
    uint index = atomicAdd(crossing_count, 1u);
    if (index >= uint(crossings.length())) {
        return;
    }
    int zeros = number == 0 ? 0 : findLSB(number);
    uint line = family | uint(number == 0 ? 128 : exponent + zeros + 128) << 8;
    uint place = uint(round(clamp(along, 0.0, 1.0) * 65535.0));
    crossings[index] =
        Crossing(edge, draw_of(word) + 1u, line, number >> zeros, place | packHalf2x16(vec2(0.0, width_px)));
}

// Finds the points where lines of one family (set of parallel strokes) pass between the pixels `a` and `b`.
// `part` limits the search to a part of the distance between the pixels.
void trace_family(Spot a, Spot b, float dark_a, float dark_b, Turn turn, uint family, uint edge, vec2 part)
{
    HatchLineStyle style = line_style();
    uint kind = strokes_of(a.word);
    towards_light = a.towards_light;
    LineField field_a = family_field(a.p, a.f, kind, family);
    LineField field_b = family_field(b.p, b.f, kind, family);
    LineField shifted = family_field(turn.sign * b.p + turn.shift, b.f, kind, family);
    DrawnLines drawn_a = drawn_lines(field_a, style, dark_a);
    DrawnLines drawn_b = drawn_lines(field_b, style, dark_b);
    Lines finest = drawn_a.lines;
    finest.level = dark_a <= 0.0   ? drawn_b.lines.level
                   : dark_b <= 0.0 ? drawn_a.lines.level
                                   : min(drawn_a.lines.level, drawn_b.lines.level);
    float half_spacing = exp2(float(finest.level - 1));
    float stray =
        1.15 * max(drawn_a.scale.wobble_px * field_a.v_per_px, drawn_b.scale.wobble_px * field_b.v_per_px);
    int first = int(ceil((min(field_a.v, shifted.v) - stray) / half_spacing));
    int last = int(floor((max(field_a.v, shifted.v) + stray) / half_spacing));
    last = min(last, first + most_lines);
    float shift_v = shifted.v - turn.sign * field_b.v;
    for (int i = first; i <= last; ++i) {
        int i_b = int(round(turn.sign * (float(i) - shift_v / half_spacing)));
        i_b = turn.sign > 0.0 && turn.shift == vec3(0.0) ? i : i_b;
        uint identity_a = line_identity(field_a, finest, i, family_seed(family));
        uint identity_b = line_identity(field_b, finest, i_b, family_seed(family));
        float at = float(i) * half_spacing;
        float off_a = field_a.v - at - field_a.v_per_px * wobble(field_a, drawn_a.scale, identity_a);
        float off_b =
            shifted.v - at - turn.sign * field_b.v_per_px * wobble(field_b, drawn_b.scale, identity_b);
        float along = off_a / (off_a - off_b);
        if ((off_a < 0.0) == (off_b < 0.0) || along < part.x || along > part.y) {
            continue;
        }
        float width_a = width_at(field_a, style, drawn_a, dark_a, i, finest.level, identity_a);
        float width_b = width_at(field_b, style, drawn_b, dark_b, i_b, finest.level, identity_b);
        float width_px = mix(width_a, width_b, along);
        if (width_px > least_width_px) {
            int count = 1 << clamp(1 - finest.level, 0, 30);
            int number = field_a.wraps ? folded(i, count) : i;
            list(edge, a.word, family, number, finest.level - 1, along, width_px);
        }
    }
}

void trace_edge(Spot a, Spot b, Turn turn, uint edge, vec2 part)
{
    if (!has_loose_ends && max(a.dark, b.dark) <= 0.0) {
        return;
    }
    float dark_a[most_families];
    float dark_b[most_families];
    darkness_of_families(a, dark_a);
    darkness_of_families(b, dark_b);
    for (uint family = 0u; family < 2u * constants.layers; ++family) {
        if (max(dark_a[family], dark_b[family]) > 0.0) {
            trace_family(a, b, dark_a[family], dark_b[family], turn, family, edge, part);
        }
    }
}

// The surface at a pixel, extrapolated by a number of pixels to the right or downwards.
Spot moved(Spot spot, bool is_down, float pixels)
{
    spot.p += pixels * (is_down ? spot.f.dy : spot.f.dx);
    return spot;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    const Turn no_turn = Turn(1.0, vec3(0.0));
    Spot here = spot_at(pixel);
    for (int i = 0; i < 2; ++i) {
        bool is_down = i == 1;
        ivec2 beside = pixel + (is_down ? ivec2(0, 1) : ivec2(1, 0));
        bool is_on_page = all(lessThan(uvec2(beside), constants.size_px));
        Spot there = spot_at(is_on_page ? beside : pixel);
        uint edge = 2u * (uint(pixel.y) * constants.size_px.x + uint(pixel.x)) + uint(i);
        Turn turn;
        if (is_on_page && goes_on(here, there, is_down, turn)) {
            trace_edge(here, there, turn, edge, vec2(0.0, 1.0));
            continue;
        }
        trace_edge(here, moved(here, is_down, 1.0), no_turn, edge, vec2(0.0, 0.5));
        if (is_on_page) {
            trace_edge(moved(there, is_down, -1.0), there, no_turn, edge, vec2(0.5, 1.0));
        }
    }
}
