// SPDX-License-Identifier: MIT
// Two threads shape one sample of a stroke: where the pen goes, and how wide it draws there, as a piece
// starts and as the piece before it ends. A place where one stroke ends and the next starts has two shapes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/draw_word.glsl"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/octahedral.glsl"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/variants.glsl.h"

layout(local_size_x = 128) in; // of 64 samples

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
    LinePoint line_points[]; // two a sample: as its piece starts, as the piece before it ends
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

layout(binding = 15) uniform usamplerBuffer look_texels; // one a draw

#define LINE_LOOKS_BINDING 16
#include "techniques/contour/chains/stroke/line_looks.glsl"

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
const bool has_looks = (variant & shape_has_looks) != 0u;

#include "techniques/contour/chains/stroke/stroke_places.glsl"
#include "techniques/contour/chains/stroke/line_width.glsl"

const float new_half_width_px = 0.15;
const float least_change_px = 0.25;
const float change_share = 0.08; // of the full width
const float most_past = 0.12;    // share of itself that a stroke runs beyond its ends

#include "techniques/contour/chains/stroke/line_phase.glsl"
#include "techniques/contour/chains/stroke/line_sway.glsl"

// Share of its width that a stroke has at a sample: it runs out where an end is free, over at most a third of
// itself.
float taper_at(uint index, Stroke stroke)
{
    float whole = whole_length(index, stroke);
    float from = arc_from_start(index, stroke);
    float reach = min(constants.taper_px, whole / 3.0);
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    float from_start = (stroke.ends & stroke_starts_at_line) != 0u ? whole : from;
    float to_end = (stroke.ends & stroke_ends_at_line) != 0u ? whole : whole - from;
    float from_end = min(from_start, to_end);
    return is_ring || reach <= 0.0 ? 1.0 : smoothstep(0.0, 1.0, (from_end + 0.25 * reach) / (1.25 * reach));
}

// Where the pen goes at a sample: past the ends, and to and fro.
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

// Along the line at a sample; where a closed one ends it starts again.
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
    float half_width = is_dropped ? 0.0 : 0.5 * full * taper_at(index, stroke);
    uint seed = hash(constants.seed, sample_at(stroke.first).source) >> 1;
    float arc_px = arc_from_start(index, stroke);
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
        drawn[index] = DrawnSample(sample_at(index).page_px, packHalf2x16(way), half_width, arc_px, seed,
                                   whole_length(index, stroke));
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
