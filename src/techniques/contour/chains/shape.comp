// SPDX-License-Identifier: MIT
// One thread shapes one sample of a stroke: where the pen goes, and how wide it draws there. A place where
// one stroke ends and the next starts has two shapes.
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

layout(local_size_x = 64) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/page_piece.glsl"

layout(scalar, binding = 1) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 2) readonly buffer CutSamples
{
    LineSample samples[];
};

layout(scalar, binding = 3) readonly buffer StrokesBefore
{
    uint strokes_before[];
};

layout(scalar, binding = 4) readonly buffer Strokes
{
    uvec2 strokes[];
};

layout(binding = 5) uniform usamplerBuffer triangle_texels;
layout(binding = 6) uniform usamplerBuffer neighbor_texels;

layout(scalar, binding = 7) readonly buffer Facing
{
    uint facing[];
};

layout(binding = 8) uniform sampler2D light_image;

#define DRAW_TEXELS_BINDING 9
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 10
#include "shaders/material_texels.glsl"

layout(scalar, binding = 11) writeonly buffer LinePoints
{
    LinePoint line_points[]; // two a sample: as its piece starts, as the piece before it ends
};

layout(push_constant, scalar) uniform Constants
{
    ShapeConstants constants;
};

// Bit 0: some material brings an outline of its own.
layout(constant_id = 0) const uint variant = 0u;
const bool has_own_outlines = (variant & 1u) != 0u;

bool is_front(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & NEIGHBOR_IS_TURNED) != 0u;
    return (facing[triangle / 32u] >> (triangle & 31u) & 1u) != (is_turned ? 1u : 0u);
}

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
    return kind == LINE_SILHOUETTE ? constants.silhouette_px
           : kind == LINE_BORDER   ? constants.border_px
           : kind == LINE_BOUNDARY ? constants.boundary_px
                                   : constants.crease_px;
}

// Kinds change from edge to edge, widths do not: the mean over a few samples of the stroke.
float even_width(uint index, uvec2 stroke)
{
    float sum = 0.0;
    for (int i = -3; i <= 3; ++i) {
        uint at = uint(clamp(int(index) + i, int(stroke.x), int(stroke.y)));
        sum += width_of(kind_now(samples[at].source));
    }
    return sum / 7.0;
}

float pressure_at(LineSample point, vec3 normal, vec2 inwards_px)
{
    float slow = value_noise(vec2(11.0, 7.0) * (point.anchor.xy + point.anchor.z) / frame.scene_radius_m,
                             constants.seed) -
                 0.5;
    ivec2 pixel = clamp(ivec2(point.page_px + inwards_px), ivec2(0), ivec2(frame.size_px) - 1);
    float shade = 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
    float away = distance(point.anchor, frame.eye_anchor);
    float thinning = mix(1.0, clamp(pow(2.2 * frame.scene_radius_m / max(away, 1e-6), 0.4), 0.45, 1.25),
                         constants.distance_thinning);
    return thinning * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

LinePoint shape_of(uint index, uvec2 stroke)
{
    LineSample point = samples[index];
    float spacing = unpackHalf2x16(point.state).y;
    vec3 normal = unpack_normal(point.normal);
    vec2 outwards = page_position(frame.clip_from_anchor *
                                  vec4(point.anchor + normal * pixel_size_m(point.anchor), 1.0)) -
                    point.page_px;
    float width = even_width(index, stroke) * pressure_at(point, normal, -2.5 * outwards);
    uint ink = 0u;
    if (has_own_outlines) {
        uint triangle = (point.source & 0x0fffffffu) >> 2;
        uint material = draw_at(texelFetch(triangle_texels, int(triangle)).w & TRIANGLE_DRAW_MASK).material;
        float own_m = outline_width_m_of(material);
        if (own_m > 0.0) {
            width = own_m / pixel_size_m(point.anchor);
            ink = material + 1u;
        }
    }
    bool is_ring = (point.state & SAMPLE_IN_RING) != 0u;
    float from_end = spacing * float(min(index - stroke.x, stroke.y - index));
    float whole = spacing * float(stroke.y - stroke.x);
    // A short stroke tapers over a third of itself at each end.
    float reach = min(constants.taper_px, whole / 3.0);
    float taper =
        is_ring || reach <= 0.0 ? 1.0 : smoothstep(0.0, 1.0, (from_end + 0.25 * reach) / (1.25 * reach));
    vec2 page = point.page_px;
    uint before = index == stroke.x ? index : index - 1u;
    uint after = index == stroke.y ? index : index + 1u;
    vec2 along = samples[after].page_px - samples[before].page_px;
    along = length(along) > 0.0 ? normalize(along) : vec2(0.0);
    if (!is_ring && constants.overshoot_px > 0.0 && whole > 6.0 * constants.overshoot_px) {
        page += along * (index == stroke.x   ? -constants.overshoot_px
                         : index == stroke.y ? constants.overshoot_px
                                             : 0.0);
    }
    if (constants.wobble_px > 0.0) {
        float arc = spacing * float(index - stroke.x) / 40.0;
        float sway = value_noise(vec2(arc, 0.5), hash(constants.seed, samples[stroke.x].source)) - 0.5;
        page += vec2(-along.y, along.x) * 2.0 * constants.wobble_px * sway * taper;
    }
    return LinePoint(page, 0.5 * width * taper, ink);
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    uint count = sizes[LIST_SAMPLES].count;
    if (index >= count) {
        return;
    }
    bool goes_on = (samples[index].state & PIECE_IS_THERE) != 0u;
    bool was_on = index > 0u && (samples[index - 1u].state & PIECE_IS_THERE) != 0u;
    if (goes_on) {
        line_points[2u * index] = shape_of(index, strokes[strokes_before[index + 1u] - 1u]);
    }
    if (was_on) {
        line_points[2u * index + 1u] = shape_of(index, strokes[strokes_before[index] - 1u]);
    }
}
