// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_FIELD
#define ESTAMPE_STROKE_FIELD

// Selects the surface coordinate whose iso-lines are the hatching strokes, for each layer.

#include "shaders/surface_images.glsl"
#include "shaders/lines.glsl"
#include "shaders/stroke_kind.glsl.h"

struct StrokeAxes {
    vec2 flat_axis_0; // direction across the strokes of the first layer, over UVs and on the page
    vec2 flat_axis_1;
    vec2 flat_axis_2;
    vec2 wind;        // horizontal direction of the wind (x, z)
    vec2 ground_wind; // direction of the wind that formed the terrain's dunes
    vec3 towards_light;
    bool has_directions; // some strokes follow wind, light, height or slope
};

// Normals of the parallel planes that slice a solid into strokes, for each layer. Where a surface is nearly
// parallel to the planes, a second family of strokes, with planes whose normals level_axis() returns,
// replaces the first family.
vec3 slice_axis(uint layer)
{
    return layer == 0u   ? vec3(0.2998, 0.8995, -0.3198)
           : layer == 1u ? vec3(0.7993, 0.4196, 0.4296)
                         : vec3(-0.6188, 0.5190, 0.5888);
}

vec3 level_axis(uint layer)
{
    return layer == 0u   ? vec3(0.3604, 0.0501, 0.9315)
           : layer == 1u ? vec3(0.8807, -0.0600, -0.4704)
                         : vec3(0.7216, 0.0401, 0.6915);
}

// Horizontal direction across the wind, rotated per layer of strokes like flat strokes.
vec3 across_wind(vec2 wind, uint layer)
{
    vec2 turn = layer == 0u ? vec2(1.0, 0.0) : layer == 1u ? vec2(0.6428, 0.7660) : vec2(0.7547, -0.6561);
    vec2 across = vec2(-wind.y, wind.x);
    return vec3(across.x * turn.x - across.y * turn.y, 0.0, across.x * turn.y + across.y * turn.x);
}

// Normals of planes that contain the light direction, so that strokes run along the light.
vec3 along_light(StrokeAxes axes, uint family)
{
    vec3 light = axes.towards_light;
    vec3 upright = normalize(cross(light, abs(light.y) < 0.99 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 lying = cross(light, upright);
    return family == 0u   ? upright
           : family == 1u ? lying
           : family == 2u ? 0.5 * upright + 0.866 * lying
           : family == 3u ? 0.866 * upright - 0.5 * lying
           : family == 4u ? 0.7071 * (upright - lying)
                          : 0.7071 * (upright + lying);
}

// Normals of planes that are tilted against the wind, so that strokes show the form of slopes. Level ground
// gets lines along its ripples. The lines bend where the ground rises or falls. Slip faces (lee sides of
// dunes) get oblique lines down the slope.
vec3 along_slope(vec2 wind, uint layer, bool is_level)
{
    vec3 across = across_wind(wind, layer);
    return is_level ? normalize(vec3(-0.3 * across.z, 1.0, 0.3 * across.x))
                    : normalize(across + vec3(0.0, 2.0, 0.0));
}

vec3 solid_axis(StrokeAxes axes, uint kind, uint family)
{
    uint layer = family >> 1;
    bool is_level = (family & 1u) != 0u;
    vec3 axis = is_level ? level_axis(layer) : slice_axis(layer);
    if (axes.has_directions) {
        vec3 wind = across_wind(axes.wind, layer);
        vec3 height = layer == 0u ? vec3(0.0, 1.0, 0.0) : normalize(wind + vec3(0.0, 0.8, 0.0));
        axis = kind == strokes_light    ? along_light(axes, family)
               : kind == strokes_height ? (is_level ? wind : height)
               : kind == strokes_wind  ? (is_level ? normalize(vec3(-0.3 * wind.z, 1.0, 0.3 * wind.x)) : wind)
               : kind == strokes_slope ? along_slope(axes.ground_wind, layer, is_level)
                                       : axis;
    }
    return axis;
}

// Direction across flat strokes. Over UVs and on the page, layers are rotated against each other. Along the
// form of a surface, layers use the form's first direction and both diagonals, because only integer
// combinations of the form's two directions are continuous everywhere.
vec3 flat_axis(StrokeAxes axes, uint kind, uint layer)
{
    vec2 turned = layer == 0u ? axes.flat_axis_0 : layer == 1u ? axes.flat_axis_1 : axes.flat_axis_2;
    vec2 form = layer == 0u ? vec2(1.0, 0.0) : layer == 1u ? vec2(1.0, 1.0) : vec2(1.0, -1.0);
    return vec3(kind == strokes_form ? form : turned, 0.0);
}

bool is_flat(uint kind)
{
    return kind == strokes_uv || kind == strokes_form || kind == strokes_page;
}

LineField field_along(vec3 axis, vec3 side, vec3 other, vec3 p, Footprint f)
{
    vec2 across = vec2(dot(axis, f.dx), dot(axis, f.dy));
    LineField field;
    field.v = dot(axis, p);
    field.v_per_px = sqrt(dot(across, across));
    vec2 along = vec2(-across.y, across.x) * (1.0 / max(field.v_per_px, 1e-18));
    float side_rate = dot(vec2(dot(side, f.dx), dot(side, f.dy)), along);
    float other_rate = dot(vec2(dot(other, f.dx), dot(other, f.dy)), along);
    bool take_side = abs(side_rate) >= abs(other_rate);
    field.wander = vec2(dot(side, p), dot(other, p));
    field.u = take_side ? field.wander.x : field.wander.y;
    field.u_per_px = max(abs(side_rate), abs(other_rate));
    field.wraps = false;
    return field;
}

#endif
