// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_ZONES
#define ESTAMPE_INK_ZONES

// The weight of a zone at a place of the page. Requires before inclusion: flow.glsl, `zone_shapes`.

float zone_shape_node(uint shape, ivec2 node)
{
    int side = int(ink_shape_side);
    return texelFetch(zone_shapes, (int(shape) * side + node.y) * side + node.x).x;
}

// 1 in the middle of the zone, 0 outside of the zone.
float share_of_zone(InkZone zone, vec2 place_mm)
{
    if (zone.shape == 0u) {
        vec2 away = (place_mm - zone.middle_mm) / zone.radius_mm;
        return zone_share(dot(away, away));
    }
    vec2 last = vec2(float(ink_shape_side - 1u));
    vec2 at = (place_mm - zone.shape_min_mm) / zone.shape_size_mm * last;
    if (any(lessThan(at, vec2(0.0f))) || any(greaterThanEqual(at, last))) {
        return 0.0f;
    }
    ivec2 node = ivec2(floor(at));
    vec2 within = at - vec2(node);
    uint shape = zone.shape - 1u;
    float upper = mix(zone_shape_node(shape, node), zone_shape_node(shape, node + ivec2(1, 0)), within.x);
    float lower =
        mix(zone_shape_node(shape, node + ivec2(0, 1)), zone_shape_node(shape, node + ivec2(1, 1)), within.x);
    float away = mix(upper, lower, within.y);
    return zone_share(away * away);
}

#endif
