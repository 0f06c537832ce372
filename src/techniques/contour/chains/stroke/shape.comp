// SPDX-License-Identifier: MIT
// Two threads handle one sample of a stroke. Both compute the pen's position and width: the first thread for
// the start of the line to the next sample, the second for the end of the line from the previous sample. The
// results differ where one stroke ends and the next starts.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 128) in; // 64 samples with 2 threads each

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/link/page_piece.glsl"

layout(scalar, binding = 1) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SAMPLES_BINDING 2
#define STROKES_BEFORE_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) readonly buffer Strokes
{
    Stroke strokes[];
};

layout(binding = 5) uniform usamplerBuffer triangle_texels;
layout(binding = 6) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 7
#include "techniques/contour/chains/extract/facing.glsl"

layout(binding = 8) uniform sampler2D light_image;

#define DRAW_TEXELS_BINDING 9
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 10
#include "shaders/material_texels.glsl"

layout(scalar, binding = 11) writeonly buffer LinePoints
{
    // Two LinePoints per sample: one for the start of the line to the next sample, one for the end of the
    // line from the previous sample.
    LinePoint line_points[];
};

layout(scalar, binding = 12) readonly buffer Recalls
{
    Recall recalls[];
};

layout(scalar, binding = 13) writeonly buffer DrawnSamples
{
    DrawnSample drawn[];
};

layout(scalar, binding = 14) writeonly buffer LineTouches
{
    LineTouch touches[];
};

// The style variant of each draw (one primitive of a mesh in one place).
layout(binding = 15) uniform usamplerBuffer variant_texels;

#define VARIANT_LINES_BINDING 16
#include "techniques/contour/chains/stroke/variant_lines.glsl"

layout(push_constant, scalar) uniform Constants
{
    ShapeConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & shape_has_own_outlines) != 0u;
const bool recalls_frame = (variant & shape_recalls_frame) != 0u;
const bool is_remembered = (variant & shape_is_remembered) != 0u;
const bool has_brushes = (variant & shape_has_brushes) != 0u;
const bool has_sway = (variant & shape_has_sway) != 0u;
const bool has_jitter = (variant & shape_has_jitter) != 0u;
const bool has_widths_m = (variant & shape_has_widths_m) != 0u;
const bool swells_in_turns = (variant & shape_swells_in_turns) != 0u;
const bool swells_in_shade = (variant & shape_is_even_in_shade) == 0u;
const bool is_hidden = (variant & shape_is_hidden) != 0u;
const bool stretches = (variant & shape_stretches) != 0u;
const bool has_variants = (variant & shape_has_variants) != 0u;
const bool has_inks_by_kind = (variant & shape_has_inks_by_kind) != 0u;

#include "techniques/contour/chains/stroke/kind_now.glsl"
#include "techniques/contour/chains/stroke/stroke_places.glsl"

// Width that lines have in the middle of a stroke.

const float near_step_mm = 1.0;
const float far_step_mm = 16.0;
const float light_weight = 0.7;
const float heavy_weight = 1.3;

float thinning_at(vec3 anchor)
{
    float away = size_of(anchor - frame.eye_anchor);
    return mix(1.0, thinned_at(frame, away), constants.distance_thinning);
}

// The draw (primitive of a mesh) to whose surface a line belongs. `source` is LineSample::source.
uint drawn_by(uint source)
{
    return texelFetch(triangle_texels, int((source & 0x0fffffffu) >> 2)).w & triangle_draw_mask;
}

uint style_variant_of(uint source)
{
    return texelFetch(variant_texels, int(drawn_by(source))).x;
}

// How much wider an outline is drawn because of what it says: most where something near passes before
// something far, and where an edge touches what lies behind it, as at the foot of a box.
float weight_at(uint index)
{
    LineSample point = sample_at(index);
    uint kind = kind_now(point.source);
    if (kind != line_silhouette && kind != line_border && kind != line_clump) {
        return 1.0;
    }
    float step_mm = depth_step_mm(point.state);
    bool is_edge = (point.source & 3u) != 3u;
    float touch = is_edge ? 1.0 - smoothstep(0.5 * touching_mm, touching_mm, step_mm) : 0.0;
    float far = log2(max(step_mm, near_step_mm) / near_step_mm) / log2(far_step_mm / near_step_mm);
    float most = max(touch, min(far, 1.0));
    return mix(1.0, mix(light_weight, heavy_weight, most), constants.rank);
}

// Full width of a line at a sample, before pressure and thinning. Widths in metres are exact, so the weight
// of a line leaves them alone.
float width_at(uint index)
{
    LineSample point = sample_at(index);
    uint kind = kind_now(point.source);
    float width = constants.width_of_kind[kind];
    bool in_metres = (constants.metre_kinds >> kind & 1u) != 0u;
    if (has_variants) {
        uint style_variant = style_variant_of(point.source);
        float own = variant_width_of(style_variant, kind);
        width = !is_hidden ? own : own > 0.0 ? width : 0.0;
        in_metres = !is_hidden && is_in_metres(style_variant, kind);
    }
    if (has_widths_m && in_metres) {
        // Perspective already makes a width in metres smaller at a distance. The division cancels the
        // thinning by distance that is applied later.
        return width / (pixel_size_m(frame, point.anchor) * thinning_at(point.anchor));
    }
    return width * weight_at(index);
}

// Mean width over a few samples of the stroke: the kind of line may change from edge to edge, but the line's
// width should not jump.
float even_width(uint index, Stroke stroke)
{
    uint from = max(index, stroke.first + 3u) - 3u;
    uint to = min(index + 3u, stroke.last);
    float sum = 0.0;
    for (uint at = from; at <= to; ++at) {
        sum += width_at(at);
    }
    return sum / float(to - from + 1u);
}

// How tightly a stroke bends around a sample: 1 if the bend's radius is `turn_px` or smaller, 0 if the stroke
// is straight.
float turn_at(uint index, Stroke stroke)
{
    const uint reach = 5u;
    uint middle = clamp(index, stroke.first + reach, max(stroke.last, stroke.first + 2u * reach) - reach);
    middle = min(middle, stroke.last);
    uint before = max(middle, stroke.first + reach) - reach;
    vec2 arriving = sample_at(middle).page_px - sample_at(before).page_px;
    vec2 leaving = sample_at(min(middle + reach, stroke.last)).page_px - sample_at(middle).page_px;
    float lengths = size_of(arriving) * size_of(leaving);
    float turn = lengths > 0.0 ? acos(clamp(dot(arriving, leaving) / lengths, -1.0, 1.0)) : 0.0;
    return clamp(constants.turn_px * turn / max(0.5 * (size_of(arriving) + size_of(leaving)), 1.0), 0.0, 1.0);
}

// How dark the surface is beside a sample, 0 to 1.
float shade_at(uint index)
{
    LineSample point = sample_at(index);
    vec3 outside = point.anchor + unpack_normal(point.normal) * pixel_size_m(frame, point.anchor);
    vec2 outwards_px = page_position(frame.clip_from_anchor * vec4(outside, 1.0)) - point.page_px;
    ivec2 pixel = clamp(ivec2(point.page_px - 2.5 * outwards_px), ivec2(0), ivec2(frame.size_px) - 1);
    return 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
}

const float lost_step_mm = 1.5; // the shade is averaged over four such steps along the stroke
const float lost_slow = 0.4;    // how unevenly lines are lost
const float lost_soft = 0.15;
const float lost_shade = 0.5; // the shade up to which lines are lost if `lost` is 1

// Share of a line's width that is left where light falls on it: lost lines are open on the lit side of a
// shape, and close in its shade. `slow` is a noise from -0.5 to 0.5.
float found_at(uint index, Stroke stroke, float slow)
{
    int step = int(max(lost_step_mm * frame.pixels_per_mm / max(spacing_px(index), 1.0), 1.0));
    float shade = 0.0;
    for (int i = -2; i <= 2; ++i) {
        int at = clamp(int(index) + i * step, int(stroke.first), int(stroke.last));
        shade += 0.2 * shade_at(uint(at));
    }
    float all_found = -0.5 * lost_slow - lost_soft; // below the least value of the sum
    float least = mix(all_found, lost_shade, constants.lost);
    return smoothstep(least - lost_soft, least + lost_soft, shade + lost_slow * slow);
}

float pressure_at(uint index, Stroke stroke)
{
    LineSample point = sample_at(index);
    float slow = value_noise(vec2(11.0, 7.0) * (point.anchor.xy + point.anchor.z) / frame.scene_radius_m,
                             constants.seed) -
                 0.5;
    float share = constants.lost > 0.0 ? found_at(index, stroke, slow) : 1.0;
    float shade = shade_at(index);
    if (swells_in_turns) {
        float turn = turn_at(index, stroke);
        shade = swells_in_shade ? shade + turn - shade * turn : turn;
    }
    return share * thinning_at(point.anchor) * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

// Full width that the line would have at a sample in the middle of a stroke. `ink` becomes the ink number of
// a LinePoint.
float full_width(uint index, Stroke stroke, out uint ink)
{
    LineSample point = sample_at(index);
    float width = even_width(index, stroke) * pressure_at(index, stroke);
    ink = 0u;
    if (has_variants || has_inks_by_kind) {
        uint kind = has_inks_by_kind ? kind_now(point.source) : 0u;
        kind = kind == line_clump ? line_silhouette : kind; // both have the ink of outlines
        ink = ink_of_variant | (line_kind_count - 1u - kind) << ink_kind_shift;
        ink |= has_variants ? style_variant_of(point.source) : 0u;
    }
    if (has_own_outlines) {
        uint material = draw_at(drawn_by(point.source)).material;
        float own_m = outline_width_m_of(material);
        if (own_m > 0.0) {
            width = own_m / pixel_size_m(frame, point.anchor);
            ink = material + 1u;
        }
    }
    return width;
}

const float new_half_width_px = 0.15;
const float least_change_px = 0.25;
const float change_share = 0.08; // largest change of a line's width per frame, as a share of the full width
// Largest length by which a stroke overshoots at each end, as a share of the stroke's length.
const float most_past = 0.12;

// Position of a stroke's samples along the stroke's brush. The position follows the surface from frame to
// frame.

const int phase_reach = 6; // number of samples on either side over which offsets are averaged
// Offsets along the brush that differ by less than one_phase_px pixels are averaged, because such offsets
// belong to one brush.
const float one_phase_px = 3.0;
// An unevenly stretched brush becomes even again only if its displacement is less than most_stretch, as a
// share of the stroke's length.
const float most_stretch = 0.2;
const float most_settling_px = 0.15;
// Range of the random position at which each stroke starts on a repeating brush.
const float most_start_px = 2048.0;
const float most_slide = 0.02; // largest slide of a stretched brush per frame, as a share of the brush
// Smallest scale of a stretched brush near the ends of a stroke; 1 is the scale of an evenly stretched brush.
const float least_pace = 0.2;

bool has_past(uint index)
{
    return recalls[index].half_width_px >= 0.0;
}

// Returns a sample's position on the brush in the previous frame minus the sample's current arc length. The
// offset comes from the nearest sample that existed in the previous frame, preferably in the same stroke, and
// is averaged with similar neighbours.
float recalled_offset(uint index, Stroke stroke, uint seed, float otherwise)
{
    int nearest = 4 * phase_reach;
    float offset = otherwise;
    for (int i = -phase_reach; i <= phase_reach; ++i) {
        int at = clamp(int(index) + i, int(stroke.first), int(stroke.last));
        int rank = abs(i) + (recalls[at].seed == seed ? 0 : 2 * phase_reach);
        if (rank < nearest && has_past(uint(at))) {
            nearest = rank;
            offset = recalls[at].offset_px;
        }
    }
    float sum = 0.0;
    float count = 0.0;
    for (int i = -phase_reach; i <= phase_reach; ++i) {
        int at = clamp(int(index) + i, int(stroke.first), int(stroke.last));
        if (has_past(uint(at)) && abs(recalls[at].offset_px - offset) < one_phase_px) {
            sum += recalls[at].offset_px;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : offset;
}

// Returns the mean, over all samples of a stroke, of the position on the brush minus the arc length.
float offset_of(Stroke stroke)
{
    return float(stroke.offset_sum) / (16.0 * float(max(stroke.offset_count, 1u)));
}

// Position of a sample on a repeating brush, in pixels. From frame to frame, the position slowly moves
// towards the position at which the brush is evenly spaced along the whole stroke. The position stays as it
// is if the evenly spaced position is far away, because the two positions then belong to different repeats or
// strokes.
float repeated_phase(uint index, Stroke stroke, uint seed)
{
    float arc = arc_on_brush(index, stroke);
    float start = most_start_px * unit_float(hash(seed));
    if (!recalls_frame) {
        return arc + start;
    }
    bool has_whole = stroke.offset_count > 0u;
    float whole = has_whole ? offset_of(stroke) : start;
    float offset = recalled_offset(index, stroke, seed, whole);
    bool settles = has_whole && abs(whole - offset) < most_stretch * brush_length(index, stroke);
    float step = clamp(constants.settling * (whole - offset), -most_settling_px, most_settling_px);
    return arc + offset + (settles ? step : 0.0);
}

// Position of a sample on a brush that stretches over the whole stroke. If the stroke was different in the
// previous frame, the brush's position moves to the new position over several frames. The brush's ends stay
// near the stroke's ends, even if the stroke grows fast. On a ring (closed stroke), the brush starts where
// the brush started in the previous frame.
float stretched_phase(uint index, Stroke stroke, uint seed)
{
    float arc = arc_on_brush(index, stroke);
    float whole = brush_length(index, stroke);
    if (!recalls_frame) {
        return arc;
    }
    if ((sample_at(index).state & sample_in_ring) != 0u) {
        return whole * fract((arc + offset_of(stroke)) / max(whole, 1.0));
    }
    float offset = recalled_offset(index, stroke, seed, 0.0);
    float most = constants.settling > 0.0 ? most_slide * whole : 0.0;
    float phase = arc + offset - clamp(offset, -most, most);
    return clamp(phase, least_pace * arc, whole - least_pace * (whole - arc));
}

// The kind of line whose brush draws a sample, or brush_hidden.
uint brush_use(uint index)
{
    return is_hidden ? brush_hidden : kind_now(sample_at(index).source);
}

LineTouch touch_of(uint index, Stroke stroke, float phase_px, vec2 way)
{
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    uint uses = brush_use(index);
    uses |= index == stroke.first && !is_ring ? touch_is_start : 0u;
    uses |= index == stroke.last && !is_ring ? touch_is_end : 0u;
    return LineTouch(phase_px, arc_on_brush(index, stroke), brush_length(index, stroke), packHalf2x16(way),
                     uses);
}

// Wobble of the simulated hand. The wobble depends only on the place in the scene. So the wobble is equal in
// every frame, lines that meet wobble together, and closed lines stay closed.

float lattice_value(ivec3 cell, uint seed)
{
    return unit_float(hash(uint(cell.x) * 0x9e3779b1u ^ uint(cell.y) * 0x85ebca77u ^
                           uint(cell.z) * 0x27d4eb2fu ^ seed * 0xc2b2ae3du));
}

// Value noise in [0, 1] with one random value per unit of length.
float value_noise(vec3 p, uint seed)
{
    ivec3 cell = ivec3(floor(p));
    vec3 f = p - vec3(cell);
    f = f * f * (3.0 - 2.0 * f);
    vec4 near;
    for (int i = 0; i < 4; ++i) {
        ivec3 corner = cell + ivec3(i & 1, i >> 1, 0);
        near[i] = mix(lattice_value(corner, seed), lattice_value(corner + ivec3(0, 0, 1), seed), f.z);
    }
    return mix(mix(near.x, near.y, f.x), mix(near.z, near.w, f.x), f.y);
}

// Noise in [-1, 1] whose features are about `wave_px` long on the page. The function blends two noises whose
// feature sizes are powers of two in the scene. The two noises have the feature sizes that are nearest to the
// wanted length.
float stray_at(vec3 anchor, float wave_px, uint seed)
{
    float octave = log2(max(wave_px * pixel_size_m(frame, anchor), 1e-20));
    float low = floor(octave);
    float fine = value_noise(anchor * exp2(-low), seed);
    float coarse = value_noise(anchor * exp2(-low - 1.0), seed + 1u);
    float part = octave - low;
    // The weighted mean of two noises varies less than a single noise. The factor with the inverse square
    // root restores the range.
    return 2.0 * (mix(fine, coarse, part) - 0.5) * inversesqrt(1.0 - 2.0 * part + 2.0 * part * part);
}

float sway_at(vec3 anchor, uint seed)
{
    return 0.75 * stray_at(anchor, constants.wave_px, seed) +
           0.25 * stray_at(anchor, 0.35 * constants.wave_px, seed + 2u);
}

// Random differences between strokes, and between the drawings of one stroke that is drawn several times.

const float again_width = 0.85;
// A noise decides where a line is drawn again. The constant is the noise's wavelength, as a multiple of the
// wobble's wavelength.
const float again_wave = 7.0;

uint hand_seed(uint what)
{
    return hash(constants.seed, 16u * constants.hand + what);
}

// Distances by which a stroke extends past the start and past the end of the line; negative values shorten
// the stroke.
vec2 ends_px(uint seed)
{
    uint start = hash(seed, hand_seed(1u));
    return constants.jitter_ends_px * (2.0 * vec2(unit_float(start), unit_float(hash(start))) - 1.0);
}

// Distance of the pen from the exact line, in pixels.
float offset_at(vec3 anchor)
{
    float aside = constants.jitter_offset_px * stray_at(anchor, 4.0 * constants.wave_px, hand_seed(2u));
    float again = constants.retrace_px * stray_at(anchor, 3.0 * constants.wave_px, hand_seed(4u));
    return aside + (constants.hand > 0u ? again : 0.0);
}

// Factor on the width of a stroke at a sample, from the random jitter of the hand.
float stray_width(uint index, Stroke stroke, uint seed)
{
    vec3 anchor = sample_at(index).anchor;
    float whole = whole_length(index, stroke);
    float soft = spacing_px(index) + min(0.5 * constants.taper_px, 0.25 * whole);
    float from_start = arc_from_start(index, stroke);
    vec2 to_ends = vec2(from_start, whole - from_start);
    vec2 short_px = max(-ends_px(seed), vec2(0.0));
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    short_px = is_ring ? vec2(0.0) : min(short_px, vec2(0.4 * whole));
    vec2 left = mix(vec2(1.0), smoothstep(vec2(0.0), vec2(soft), to_ends - short_px),
                    greaterThan(short_px, vec2(0.0)));
    float share = min(left.x, left.y);
    share *= 1.0 + constants.jitter_width *
                       clamp(stray_at(anchor, 2.0 * constants.wave_px, hand_seed(6u)), -1.0, 1.0);
    float again = stray_at(anchor, again_wave * constants.wave_px, hand_seed(8u));
    return constants.hand > 0u ? share * again_width * smoothstep(-0.35, 0.1, again) : share;
}

// Factor on the width of a stroke at a sample: strokes taper towards free ends, over at most one third of the
// stroke's length. An end at another line is blunt, because a pen's line runs into the other line; a brush is
// set down there, and leaves a round end.
float taper_at(uint index, Stroke stroke, float full_px)
{
    if ((sample_at(index).state & sample_in_ring) != 0u) {
        return 1.0;
    }
    float whole = whole_length(index, stroke);
    float reach = min(constants.taper_px, whole / 3.0);
    float from_start = arc_from_start(index, stroke);
    vec2 from_ends = vec2(from_start, whole - from_start);
    bvec2 is_at_line =
        bvec2((stroke.ends & stroke_starts_at_line) != 0u, (stroke.ends & stroke_ends_at_line) != 0u);
    vec2 tapers = reach > 0.0 ? smoothstep(vec2(0.0), vec2(1.0), (from_ends + 0.25 * reach) / (1.25 * reach))
                              : vec2(1.0);
    vec2 blunt = vec2(1.0);
    bool has_brush = has_brushes && (constants.brush_uses >> brush_use(index) & 1u) != 0u;
    if (has_brush) {
        vec2 to_round = 1.0 - min((from_ends + 0.1 * full_px) / max(0.7 * full_px, 1e-3), 1.0);
        blunt = sqrt(1.0 - to_round * to_round);
    }
    vec2 share = mix(tapers, blunt, is_at_line);
    if (constants.gap_px > 0.0) {
        bvec2 is_behind =
            bvec2((stroke.ends & stroke_starts_behind) != 0u, (stroke.ends & stroke_ends_behind) != 0u);
        vec2 stopped = smoothstep(vec2(constants.gap_px), vec2(constants.gap_px + 0.5 * full_px), from_ends);
        share *= mix(vec2(1.0), stopped, is_behind);
    }
    return min(share.x, share.y);
}

// Position of the pen on the page at a sample, including overshoot and wobble.
vec2 pen_at(uint index, Stroke stroke, vec2 way, uint seed)
{
    vec2 page = sample_at(index).page_px;
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    if (!is_ring && stroke.last - stroke.first > 4u) {
        vec2 past = vec2(constants.overshoot_px);
        if (has_jitter) {
            past += max(ends_px(seed), vec2(0.0));
        }
        past = min(past, vec2(most_past * whole_length(index, stroke)));
        page += (index == stroke.first ? -past.x : index == stroke.last ? past.y : 0.0) * way;
    }
    float aside = 0.0;
    if (has_sway) {
        aside +=
            constants.wobble_px * sway_at(sample_at(index).anchor, constants.seed + 101u * constants.hand);
    }
    if (has_jitter) {
        aside += offset_at(sample_at(index).anchor);
    }
    return page + aside * vec2(-way.y, way.x);
}

// Direction of the line on the page at a sample. A closed line continues from the end of the line to the
// start.
vec2 way_at(uint index, Stroke stroke)
{
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    uint previous = index > stroke.first ? index - 1u : is_ring ? stroke.last - 1u : index;
    uint next = index < stroke.last ? index + 1u : is_ring ? stroke.first + 1u : index;
    vec2 way = sample_at(next).page_px - sample_at(previous).page_px;
    return way * inversesqrt(max(dot(way, way), 1e-20));
}

LinePoint shape_of(uint index, Stroke stroke, bool remembers)
{
    uint ink;
    float full = full_width(index, stroke, ink);
    bool is_dropped = (stroke.ends & stroke_is_dropped) != 0u;
    float half_width = is_dropped ? 0.0 : 0.5 * full * taper_at(index, stroke, full);
    uint seed = hash(constants.seed, sample_at(stroke.first).source) >> 1;
    float arc_px = arc_on_brush(index, stroke);
    if (recalls_frame) {
        if (stroke.recalled != no_sample) {
            seed = recalls[sample_from_middle(stroke.recalled, stroke)].seed;
        }
        arc_px += offset_of(stroke);
        float before = recalls[index].half_width_px;
        before = before >= 0.0 ? before : new_half_width_px;
        float most_change = max(least_change_px, change_share * 0.5 * full);
        half_width = clamp(half_width, before - most_change, before + most_change);
    }
    vec2 way = way_at(index, stroke);
    if (has_brushes) {
        arc_px = stretches ? stretched_phase(index, stroke, seed) : repeated_phase(index, stroke, seed);
        touches[gl_GlobalInvocationID.x] = touch_of(index, stroke, arc_px, way);
    }
    if (is_remembered && remembers) {
        vec2 page_px = page_position(frame.clip_from_anchor * vec4(sample_at(index).anchor, 1.0));
        drawn[index] =
            DrawnSample(page_px, packHalf2x16(way), half_width, arc_px, seed, brush_length(index, stroke));
    }
    if (has_jitter) {
        half_width *= stray_width(index, stroke, seed);
    }
    return LinePoint(pen_at(index, stroke, way, seed), half_width, ink);
}

void main()
{
    uint index = gl_GlobalInvocationID.x / 2u;
    bool is_start = (gl_GlobalInvocationID.x & 1u) == 0u;
    if (index >= sizes[list_samples].count) {
        return;
    }
    bool goes_on = (sample_at(index).state & piece_is_there) != 0u;
    bool was_on = index > 0u && (sample_at(index - 1u).state & piece_is_there) != 0u;
    if (is_start ? goes_on : was_on) {
        Stroke stroke = strokes[strokes_before(is_start ? index + 1u : index) - 1u];
        line_points[gl_GlobalInvocationID.x] = shape_of(index, stroke, is_start || !goes_on);
    }
}
