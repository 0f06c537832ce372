// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADOW_SHARE
#define ESTAMPE_SHADOW_SHARE

// What shadows leave of a light, edges and the light's breadth counted. Who includes this declares what
// shadow's lookups need, `EdgeLook edge_look`, `coordinate_image` and `footprint_image`, and which of
// has_edges, has_stroke_edges, has_wave_edges, has_soft_sun and has_soft_lamps hold.

#include "techniques/shadow/local/edge.glsl"
#include "techniques/shadow/local/local_shadow.glsl"
#include "techniques/shadow/sun/sun_shadow.glsl"

Edge edge_at(ivec2 pixel, uint word, float depth, vec3 point, vec3 normal)
{
    vec2 at_px = vec2(pixel) + 0.5;
    PageRates rates = page_rates(frame, at_px, depth, point, normal);
    Edge edge;
    edge.first = wave_teeth(edge_look.axis_0, point, rates, 1u);
    edge.second = wave_teeth(edge_look.axis_1, point, rates, 2u);
    edge.third = wave_teeth(edge_look.axis_2, point, rates, 3u);
    edge.m_per_px = distance(point, anchor_at(frame, at_px + vec2(1.0, 0.0), depth));
    if (has_stroke_edges) {
        edge.first = stroke_teeth(edge_look, strokes_of(word), texelFetch(coordinate_image, pixel, 0).xyz,
                                  unpack_footprint(texelFetch(footprint_image, pixel, 0)), normal, rates);
    }
    return edge;
}

float sun_lookup(vec3 point, vec3 normal, vec3 towards_sun, float radius_m)
{
    return has_soft_sun ? sun_soft_visibility(point, normal, towards_sun, radius_m)
                        : sun_visibility(point, normal, towards_sun);
}

float sun_share(vec3 point, vec3 normal, vec3 towards_sun, Edge edge)
{
    float penumbra_m = has_soft_sun ? sun_penumbra_m(point, normal, towards_sun) : 0.0;
    if (!has_edges) {
        return sun_lookup(point, normal, towards_sun, penumbra_m);
    }
    EdgePoints points = edge_points(edge, edge_look, has_wave_edges, point, penumbra_m);
    float radius_m = 0.5 * penumbra_m;
    float first = sun_lookup(raised(points.first, points, point, towards_sun), normal, towards_sun, radius_m);
    float second =
        sun_lookup(raised(points.second, points, point, towards_sun), normal, towards_sun, radius_m);
    return edge_blend(points, first, second);
}

// `part` is how much of the light's breadth counts.
float local_lookup(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal, Penumbra penumbra,
                   float part)
{
    return has_soft_lamps ? local_soft_visibility(shadow, light_position, point, normal,
                                                  part * shadow.radius_m, part * penumbra.widest_m)
                          : local_visibility(shadow, light_position, point, normal);
}

// Of a lamp or a spot.
float local_share(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal, Edge edge)
{
    Penumbra penumbra = Penumbra(0.0, 0.0);
    if (has_soft_lamps) {
        penumbra = local_penumbra(shadow, light_position, point, normal);
    }
    if (!has_edges) {
        return local_lookup(shadow, light_position, point, normal, penumbra, 1.0);
    }
    EdgePoints points = edge_points(edge, edge_look, has_wave_edges, point, penumbra.mean_m);
    vec3 towards_light = normalize(light_position - point);
    vec3 raised_first = raised(points.first, points, point, towards_light);
    vec3 raised_second = raised(points.second, points, point, towards_light);
    float first = local_lookup(shadow, light_position, raised_first, normal, penumbra, 0.5);
    float second = local_lookup(shadow, light_position, raised_second, normal, penumbra, 0.5);
    float share = edge_blend(points, first, second);
    if (has_wave_edges) {
        // A lamp's shadows run in all directions: it has a third axis.
        vec3 point_3 = third_wave_point(edge, edge_look, point, penumbra.mean_m);
        float third = local_lookup(shadow, light_position, point_3, normal, penumbra, 0.5);
        share = shadow.is_cube != 0u ? mix(share, third, 1.0 / 3.0) : share;
    }
    return share;
}

#endif
