// SPDX-License-Identifier: MIT
// Two threads shape one sample of a stroke: where the pen goes, and how wide it draws there, as a piece
// starts and as the piece before it ends. A place where one stroke ends and the next starts has two shapes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/draw_word.glsl"
#include "shaders/frame.glsl.h"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/octahedral.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 128) in; // of 64 samples

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/page_piece.glsl"

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
#include "techniques/contour/chains/facing.glsl"

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

layout(push_constant, scalar) uniform Constants
{
    ShapeConstants constants;
};

// Bit 0: some material brings an outline of its own. Bit 1: there was a frame before this. Bit 2: there will
// be one after it.
layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & 1u) != 0u;
const bool recalls_frame = (variant & 2u) != 0u;
const bool is_remembered = (variant & 4u) != 0u;

const float new_half_width_px = 0.15;
const float least_change_px = 0.25;
const float change_share = 0.08; // of the full width

// A fold or a boundary behind which the surface turns away is an outline there.
uint kind_now(uint source)
{
    uint kind = source >> 28;
    uint side = source & 0x0fffffffu;
    if (kind == LINE_SILHOUETTE || kind == LINE_BORDER || (side & 3u) == 3u) {
        return kind;
    }
    uint beyond = texelFetch(neighbor_texels, int(side >> 2))[side & 3u];
    return beyond != NO_SIDE && is_front(side >> 2) != is_front(beyond >> 2) ? LINE_SILHOUETTE : kind;
}

float width_of(uint kind)
{
    return kind == LINE_SILHOUETTE   ? constants.silhouette_px
           : kind == LINE_BORDER     ? constants.border_px
           : kind == LINE_BOUNDARY   ? constants.boundary_px
           : kind == LINE_MARKED     ? constants.marked_px
           : kind == LINE_RIDGE      ? constants.ridge_px
           : kind == LINE_VALLEY     ? constants.valley_px
           : kind == LINE_SUGGESTIVE ? constants.suggestive_px
                                     : constants.crease_px;
}

// Kinds change from edge to edge, widths do not: the mean over a few samples of the stroke.
float even_width(uint index, Stroke stroke)
{
    uint from = max(index, stroke.first + 3u) - 3u;
    uint to = min(index + 3u, stroke.last);
    float sum = 0.0;
    for (uint at = from; at <= to; ++at) {
        sum += width_of(kind_now(sample_at(at).source));
    }
    return sum / float(to - from + 1u);
}

float pressure_at(LineSample point, vec2 inwards_px)
{
    float slow = value_noise(vec2(11.0, 7.0) * (point.anchor.xy + point.anchor.z) / frame.scene_radius_m,
                             constants.seed) -
                 0.5;
    ivec2 pixel = clamp(ivec2(point.page_px + inwards_px), ivec2(0), ivec2(frame.size_px) - 1);
    float shade = 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
    float away = size_of(point.anchor - frame.eye_anchor);
    float thinning = mix(1.0, clamp(pow(2.2 * frame.scene_radius_m / max(away, 1e-6), 0.4), 0.45, 1.25),
                         constants.distance_thinning);
    return thinning * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

// Whole width that a sample would have in the middle of a stroke, and the material that brings it, + 1.
float full_width(uint index, Stroke stroke, out uint ink)
{
    LineSample point = sample_at(index);
    vec3 normal = unpack_normal(point.normal);
    float pixel_m = pixel_size_m(point.anchor);
    vec4 outside = frame.clip_from_anchor * vec4(point.anchor + normal * pixel_m, 1.0);
    vec2 outwards_px = page_position(outside) - point.page_px;
    float width = even_width(index, stroke) * pressure_at(point, -2.5 * outwards_px);
    ink = 0u;
    if (has_own_outlines) {
        uint triangle = (point.source & 0x0fffffffu) >> 2;
        uint material = draw_at(texelFetch(triangle_texels, int(triangle)).w & TRIANGLE_DRAW_MASK).material;
        float own_m = outline_width_m_of(material);
        if (own_m > 0.0) {
            width = own_m / pixel_m;
            ink = material + 1u;
        }
    }
    return width;
}

// Share of its width that a stroke has at a sample: it runs out where an end is free, over at most a third of
// itself.
float taper_at(uint index, Stroke stroke)
{
    float spacing = unpackHalf2x16(sample_at(index).state).y;
    float whole = spacing * float(stroke.last - stroke.first);
    float reach = min(constants.taper_px, whole / 3.0);
    bool is_ring = (sample_at(index).state & SAMPLE_IN_RING) != 0u;
    float from_start =
        (stroke.ends & STROKE_STARTS_AT_LINE) != 0u ? whole : spacing * float(index - stroke.first);
    float to_end = (stroke.ends & STROKE_ENDS_AT_LINE) != 0u ? whole : spacing * float(stroke.last - index);
    float from_end = min(from_start, to_end);
    return is_ring || reach <= 0.0 ? 1.0 : smoothstep(0.0, 1.0, (from_end + 0.25 * reach) / (1.25 * reach));
}

// Where the pen goes at a sample: past the ends, and to and fro.
vec2 pen_at(uint index, Stroke stroke, vec2 way, float arc_px, uint seed)
{
    vec2 page = sample_at(index).page_px;
    bool is_ring = (sample_at(index).state & SAMPLE_IN_RING) != 0u;
    if (!is_ring && stroke.last - stroke.first > 4u) {
        float past = index == stroke.first ? -1.0 : index == stroke.last ? 1.0 : 0.0;
        page += past * constants.overshoot_px * way;
    }
    float sway = value_noise(vec2(arc_px / 40.0, 0.5), seed) - 0.5;
    return page + 2.0 * constants.wobble_px * sway * vec2(-way.y, way.x);
}

LinePoint shape_of(uint index, Stroke stroke, bool remembers)
{
    uint ink;
    float full = full_width(index, stroke, ink);
    bool is_dropped = (stroke.ends & STROKE_IS_DROPPED) != 0u;
    float half_width = is_dropped ? 0.0 : 0.5 * full * taper_at(index, stroke);
    uint seed =
        stroke.seed != NO_SEED ? stroke.seed : hash(constants.seed, sample_at(stroke.first).source) >> 1;
    float arc_px = unpackHalf2x16(sample_at(index).state).y * float(index - stroke.first);
    if (recalls_frame) {
        arc_px +=
            stroke.offset_count > 0u ? float(stroke.offset_sum) / (16.0 * float(stroke.offset_count)) : 0.0;
        float before = recalls[index].half_width_px;
        before = before >= 0.0 ? before : new_half_width_px;
        float most_change = max(least_change_px, change_share * 0.5 * full);
        half_width = clamp(half_width, before - most_change, before + most_change);
    }
    uint previous = index == stroke.first ? index : index - 1u;
    uint next = index == stroke.last ? index : index + 1u;
    vec2 way = sample_at(next).page_px - sample_at(previous).page_px;
    way *= inversesqrt(max(dot(way, way), 1e-20));
    if (is_remembered && remembers) {
        drawn[index] = DrawnSample(sample_at(index).page_px, packHalf2x16(way), half_width, arc_px, seed);
    }
    return LinePoint(pen_at(index, stroke, way, arc_px, seed), half_width, ink);
}

void main()
{
    uint index = gl_GlobalInvocationID.x / 2u;
    bool is_start = (gl_GlobalInvocationID.x & 1u) == 0u;
    if (index >= sizes[LIST_SAMPLES].count) {
        return;
    }
    bool goes_on = (sample_at(index).state & PIECE_IS_THERE) != 0u;
    bool was_on = index > 0u && (sample_at(index - 1u).state & PIECE_IS_THERE) != 0u;
    if (is_start ? goes_on : was_on) {
        Stroke stroke = strokes[strokes_before(is_start ? index + 1u : index) - 1u];
        line_points[gl_GlobalInvocationID.x] = shape_of(index, stroke, is_start || !goes_on);
    }
}
