// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADOW_SHARE
#define ESTAMPE_SHADOW_SHARE

// Share of a light that shadows leave, with toothed edges and penumbrae. The including shader declares the
// names that the lookups need, `EdgeProfile edge_profile`, `coordinate_image` and `footprint_image`, and the
// constants has_edges, has_stroke_edges, has_wave_edges, has_soft_sun and has_soft_lamps.
//
// Shadow edges have teeth (small strokes), as illustrators draw them. The lookup point is moved along the
// surface, back and forth across a coordinate v that is fixed to the world. So the shadow's edge breaks up
// into strokes that stay in place when the eye moves. After Zanuttini, "Recherches en rendu non realiste
// temps reel", 2008, who moves the point along the world's axes. Length and density of the teeth are measured
// on the page. Where the coordinate v follows the hatching lines, each tooth is the end of a stroke.

#include "shaders/camera.glsl"
#include "shaders/stroke_field.glsl"
#include "techniques/shadow/shadow.glsl.h"
#include "techniques/shadow/local/teeth.glsl"
#include "techniques/shadow/local/local_shadow.glsl"
#include "techniques/shadow/sun/sun_shadow.glsl"

// Metres on the surface per pixel of the page, in x and in y.
struct PageRates {
    vec3 dx;
    vec3 dy;
};

// A set of parallel teeth (small strokes) of a shadow edge, at a pixel.
struct Teeth {
    LineField field; // the coordinate across the teeth (small strokes), and its change per pixel
    vec3 step_m;     // vector along the teeth (small strokes) that is one pixel long on the page
    uint seed;
};

// Two points near the surface point. The light is looked up at the two nearby points, not at the surface
// point.
struct EdgePoints {
    vec3 first;
    vec3 second;
    // How to combine the light at the two lookup points: 0 takes the mean, a positive value the darker light,
    // a negative value the lighter light.
    float lean;
};

// Intersection of the view ray at `at_px` with the plane through `point`, limited at grazing angles. `depth`
// is the depth of `point`.
vec3 on_plane(FrameGlobals frame, vec2 at_px, float depth, vec3 point, vec3 normal)
{
    vec3 beside = anchor_at(frame, at_px, depth);
    vec3 ray = -towards_eye(frame, beside);
    float facing = dot(normal, ray);
    facing = facing < 0.0 ? min(facing, -0.1) : max(facing, 0.1);
    return beside + ray * (dot(normal, point - beside) / facing);
}

PageRates page_rates(FrameGlobals frame, vec2 at_px, float depth, vec3 point, vec3 normal)
{
    return PageRates(on_plane(frame, at_px + vec2(1.0, 0.0), depth, point, normal) - point,
                     on_plane(frame, at_px + vec2(0.0, 1.0), depth, point, normal) - point);
}

Teeth teeth_across(float v, vec2 v_rate, PageRates rates, bool wraps, uint seed)
{
    Teeth teeth;
    teeth.field.v = v;
    teeth.field.v_per_px = length(v_rate);
    teeth.field.u = 0.0;
    teeth.field.u_per_px = 0.0;
    teeth.field.wander = vec2(0.0);
    teeth.field.wraps = wraps;
    vec2 along = vec2(-v_rate.y, v_rate.x) / max(teeth.field.v_per_px, 1e-20);
    teeth.step_m = rates.dx * along.x + rates.dy * along.y;
    teeth.seed = seed;
    return teeth;
}

// Shadow edge teeth (small strokes) along parallel planes that cut the world into slices.
Teeth wave_teeth(vec3 axis, vec3 point, PageRates rates, uint seed)
{
    return teeth_across(dot(axis, point), vec2(dot(axis, rates.dx), dot(axis, rates.dy)), rates, false, seed);
}

// Shadow edge teeth (small strokes) that are the ends of the strokes of the hatching's first layer.
Teeth stroke_teeth(EdgeProfile profile, uint kind, vec3 coordinate, Footprint f, vec3 normal, PageRates rates)
{
    StrokeAxes axes = StrokeAxes(profile.flat_axis, profile.flat_axis, profile.flat_axis, profile.wind,
                                 profile.ground_wind, profile.towards_light, profile.has_directions != 0u);
    bool is_level = length(cross(solid_axis(axes, kind, 0u), normal)) < 0.59;
    uint family = !is_flat(kind) && is_level ? 1u : 0u;
    vec3 axis = is_flat(kind) ? flat_axis(axes, kind, 0u) : solid_axis(axes, kind, family);
    return teeth_across(dot(axis, coordinate), vec2(dot(axis, f.dx), dot(axis, f.dy)), rates,
                        kind == strokes_form, hash(profile.seed * 64u + family));
}

// Displacement of a shadow edge by its teeth (small strokes). Teeth get wider with the penumbra.
float edge_tooth(Teeth teeth, EdgeProfile profile, float penumbra_px)
{
    return tooth(teeth.field, teeth.seed, profile.width_px + penumbra_px / 8.0, profile.darkness,
                 profile.variety);
}

// Lookup points for shadow edge teeth that are the ends of hatching strokes. On the lit side, strokes extend
// past the shadow edge; on the dark side, they leave gaps of light.
EdgePoints stroke_edge(Teeth teeth, EdgeProfile profile, vec3 point, float penumbra_px)
{
    float lean = edge_tooth(teeth, profile, penumbra_px);
    vec3 shift = teeth.step_m * (lean * (profile.amplitude_px + 0.5f * penumbra_px));
    return EdgePoints(point + shift, point - shift, lean);
}

// Lookup points for wave-shaped teeth (small strokes) of a shadow edge: one point along each of two axes. The
// mean of the light at the two points is used.
EdgePoints wave_edge(Teeth first, Teeth second, EdgeProfile profile, vec3 point, float penumbra_px)
{
    float reach_px = profile.amplitude_px + 0.5f * penumbra_px;
    return EdgePoints(point + first.step_m * (reach_px * edge_tooth(first, profile, penumbra_px)),
                      point + second.step_m * (reach_px * edge_tooth(second, profile, penumbra_px)), 0.0f);
}

// Data of a pixel that the shadow edges of all lights share.
struct Edge {
    Teeth first;
    Teeth second;   // second set of teeth (small strokes); only for wave-shaped teeth
    Teeth third;    // third set of teeth (small strokes); only for wave-shaped teeth of lamps' shadows
    float m_per_px; // metres per pixel on a surface that faces the eye
};

EdgePoints edge_points(Edge edge, EdgeProfile profile, bool is_waves, vec3 point, float penumbra_m)
{
    float penumbra_px = penumbra_m / max(edge.m_per_px, 1e-20);
    return is_waves ? wave_edge(edge.first, edge.second, profile, point, penumbra_px)
                    : stroke_edge(edge.first, profile, point, penumbra_px);
}

// The third lookup point for wave-shaped teeth (small strokes) of a shadow edge, for omnidirectional lights.
vec3 third_wave_point(Edge edge, EdgeProfile profile, vec3 point, float penumbra_m)
{
    float penumbra_px = penumbra_m / max(edge.m_per_px, 1e-20);
    float reach_px = profile.amplitude_px + 0.5f * penumbra_px;
    return point + edge.third.step_m * (reach_px * edge_tooth(edge.third, profile, penumbra_px));
}

// Raises, towards the light, a lookup point that was moved into shadow. Without the raise, the moved point
// could lie inside a curved or folded surface, which would then shadow itself.
vec3 raised(vec3 moved, EdgePoints points, vec3 point, vec3 towards_light)
{
    return points.lean < 0.0f ? moved : moved + towards_light * (0.7f * distance(moved, point));
}

// Combines the light at the two lookup points of a shadow edge.
float edge_blend(EdgePoints points, float first, float second)
{
    return points.lean > 0.0f   ? min(first, second)
           : points.lean < 0.0f ? max(first, second)
                                : 0.5f * (first + second);
}

Edge edge_at(ivec2 pixel, uint word, float depth, vec3 point, vec3 normal)
{
    vec2 at_px = vec2(pixel) + 0.5;
    PageRates rates = page_rates(frame, at_px, depth, point, normal);
    Edge edge;
    edge.first = wave_teeth(edge_profile.axis_0, point, rates, 1u);
    edge.second = wave_teeth(edge_profile.axis_1, point, rates, 2u);
    edge.third = wave_teeth(edge_profile.axis_2, point, rates, 3u);
    edge.m_per_px = distance(point, anchor_at(frame, at_px + vec2(1.0, 0.0), depth));
    if (has_stroke_edges) {
        edge.first = stroke_teeth(edge_profile, strokes_of(word), texelFetch(coordinate_image, pixel, 0).xyz,
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
    EdgePoints points = edge_points(edge, edge_profile, has_wave_edges, point, penumbra_m);
    float radius_m = 0.5 * penumbra_m;
    float first = sun_lookup(raised(points.first, points, point, towards_sun), normal, towards_sun, radius_m);
    float second =
        sun_lookup(raised(points.second, points, point, towards_sun), normal, towards_sun, radius_m);
    return edge_blend(points, first, second);
}

// Share of a lamp that arrives at a lookup point. Only the share `part` of the lamp's radius is used.
float local_lookup(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal, Penumbra penumbra,
                   float part)
{
    return has_soft_lamps ? local_soft_visibility(shadow, light_position, point, normal,
                                                  part * shadow.radius_m, part * penumbra.widest_m)
                          : local_visibility(shadow, light_position, point, normal);
}

// Share of a lamp or spot that arrives at a surface point, with toothed shadow edges.
float local_share(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal, Edge edge)
{
    Penumbra penumbra = Penumbra(0.0, 0.0);
    if (has_soft_lamps) {
        penumbra = local_penumbra(shadow, light_position, point, normal);
    }
    if (!has_edges) {
        return local_lookup(shadow, light_position, point, normal, penumbra, 1.0);
    }
    EdgePoints points = edge_points(edge, edge_profile, has_wave_edges, point, penumbra.mean_m);
    vec3 towards_light = normalize(light_position - point);
    vec3 raised_first = raised(points.first, points, point, towards_light);
    vec3 raised_second = raised(points.second, points, point, towards_light);
    float first = local_lookup(shadow, light_position, raised_first, normal, penumbra, 0.5);
    float second = local_lookup(shadow, light_position, raised_second, normal, penumbra, 0.5);
    float share = edge_blend(points, first, second);
    if (has_wave_edges) {
        // A lamp's shadows run in all directions, so the shadow edges of a lamp have teeth (small strokes)
        // across a third axis.
        vec3 point_3 = third_wave_point(edge, edge_profile, point, penumbra.mean_m);
        float third = local_lookup(shadow, light_position, point_3, normal, penumbra, 0.5);
        share = shadow.is_cube != 0u ? mix(share, third, 1.0 / 3.0) : share;
    }
    return share;
}

#endif
