// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_WIDTH
#define ESTAMPE_LINE_WIDTH

// How wide lines are in the middle of a stroke. Wanted before: all that shape.comp binds.

// A fold or a boundary behind which the surface turns away is an outline there.
uint kind_now(uint source)
{
    uint kind = source >> 28;
    uint side = source & 0x0fffffffu;
    if (kind == line_silhouette || kind == line_border || (side & 3u) == 3u) {
        return kind;
    }
    uint beyond = texelFetch(neighbor_texels, int(side >> 2))[side & 3u];
    return beyond != no_side && is_front(side >> 2) != is_front(beyond >> 2) ? line_silhouette : kind;
}

float thinning_at(vec3 anchor)
{
    float away = size_of(anchor - frame.eye_anchor);
    return mix(1.0, thinned_at(frame, away), constants.distance_thinning);
}

// The draw that a line belongs to, by the source of a sample.
uint drawn_by(uint source)
{
    return texelFetch(triangle_texels, int((source & 0x0fffffffu) >> 2)).w & triangle_draw_mask;
}

uint look_of(uint source)
{
    return texelFetch(look_texels, int(drawn_by(source))).x;
}

float width_at(uint index)
{
    LineSample point = sample_at(index);
    uint kind = kind_now(point.source);
    float width = constants.width_of_kind[kind];
    bool in_metres = (constants.metre_kinds >> kind & 1u) != 0u;
    if (has_looks) {
        uint look = look_of(point.source);
        float own = look_width_of(look, kind);
        width = !is_hidden ? own : own > 0.0 ? width : 0.0;
        in_metres = !is_hidden && is_in_metres(look, kind);
    }
    if (has_widths_m && in_metres) {
        // Thinned with the rest by and by, of which distance has done its part here.
        width /= pixel_size_m(frame, point.anchor) * thinning_at(point.anchor);
    }
    return width;
}

// Kinds change from edge to edge, widths do not: the mean over a few samples of the stroke.
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

// How much a stroke bends about a sample, 1 where its radius is `turn_px` or less.
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

float pressure_at(uint index, Stroke stroke, vec2 inwards_px)
{
    LineSample point = sample_at(index);
    float slow = value_noise(vec2(11.0, 7.0) * (point.anchor.xy + point.anchor.z) / frame.scene_radius_m,
                             constants.seed) -
                 0.5;
    ivec2 pixel = clamp(ivec2(point.page_px + inwards_px), ivec2(0), ivec2(frame.size_px) - 1);
    float shade = 1.0 - clamp(texelFetch(light_image, pixel, 0).a, 0.0, 1.0);
    if (swells_in_turns) {
        float turn = turn_at(index, stroke);
        shade = swells_in_shade ? shade + turn - shade * turn : turn;
    }
    return thinning_at(point.anchor) * mix(1.0, 0.62 + 0.75 * shade + 0.7 * slow, constants.pressure);
}

// Whole width that a sample would have in the middle of a stroke, and the material that brings it, + 1.
float full_width(uint index, Stroke stroke, out uint ink)
{
    LineSample point = sample_at(index);
    vec3 normal = unpack_normal(point.normal);
    float pixel_m = pixel_size_m(frame, point.anchor);
    vec4 outside = frame.clip_from_anchor * vec4(point.anchor + normal * pixel_m, 1.0);
    vec2 outwards_px = page_position(outside) - point.page_px;
    float width = even_width(index, stroke) * pressure_at(index, stroke, -2.5 * outwards_px);
    ink = 0u;
    if (has_looks) {
        ink = ink_of_look | look_of(point.source);
    }
    if (has_own_outlines) {
        uint material = draw_at(drawn_by(point.source)).material;
        float own_m = outline_width_m_of(material);
        if (own_m > 0.0) {
            width = own_m / pixel_m;
            ink = material + 1u;
        }
    }
    return width;
}

#endif
