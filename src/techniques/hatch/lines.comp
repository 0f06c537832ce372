// SPDX-License-Identifier: MIT
// One thread a pixel lays the strokes that carry the darkness wanted there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/draw_word.glsl"
#include "shaders/footprint.glsl"
#include "shaders/lines.glsl"
#include "shaders/octahedral.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform usampler2D normal_image;
layout(binding = 3) uniform sampler2D coordinate_image;
layout(binding = 4) uniform usampler2D footprint_image;
layout(binding = 5) uniform usampler2D source_image; // see overrun.comp
layout(binding = 6, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    LineConstants constants;
};

// Bit 0: newborn strokes grow in length. Bit 1: some strokes follow wind, light or height. Bit
// 2: strokes run over silhouettes.
layout(constant_id = 0) const uint variant = 0u;
const bool has_growth = (variant & 1u) != 0u;
const bool has_directions = (variant & 2u) != 0u;
const bool has_overrun = (variant & 4u) != 0u;

// Each layer slices the solid by parallel planes; where a surface lies nearly in such a plane a second
// family, the level one, takes over. Normals of the planes:
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

// The horizontal direction across the wind, turned as the layers of flat strokes are.
vec3 across_wind(uint layer)
{
    vec2 turn = layer == 0u ? vec2(1.0, 0.0) : layer == 1u ? vec2(0.4695, 0.8829) : vec2(0.7547, -0.6561);
    vec2 across = vec2(-constants.wind.y, constants.wind.x);
    return vec3(across.x * turn.x - across.y * turn.y, 0.0, across.x * turn.y + across.y * turn.x);
}

// Planes that contain the direction of the light, so that strokes run along it.
vec3 along_light(uint family)
{
    vec3 light = constants.towards_light;
    vec3 upright = normalize(cross(light, abs(light.y) < 0.99 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 lying = cross(light, upright);
    return family == 0u   ? upright
           : family == 1u ? lying
           : family == 2u ? 0.5 * upright + 0.866 * lying
           : family == 3u ? 0.866 * upright - 0.5 * lying
           : family == 4u ? 0.7071 * (upright - lying)
                          : 0.7071 * (upright + lying);
}

vec3 solid_axis(uint kind, uint family)
{
    uint layer = family >> 1;
    bool is_level = (family & 1u) != 0u;
    vec3 axis = is_level ? level_axis(layer) : slice_axis(layer);
    if (has_directions) {
        vec3 wind = across_wind(layer);
        vec3 height = layer == 0u ? vec3(0.0, 1.0, 0.0) : normalize(wind + vec3(0.0, 0.8, 0.0));
        axis = kind == STROKES_LIGHT    ? along_light(family)
               : kind == STROKES_HEIGHT ? (is_level ? wind : height)
               : kind == STROKES_WIND ? (is_level ? normalize(vec3(-0.3 * wind.z, 1.0, 0.3 * wind.x)) : wind)
                                      : axis;
    }
    return axis;
}

// Over UVs and on the page the layers are turned against each other; along the form they are its two
// directions and the diagonal, because only whole combinations of the two are continuous everywhere.
vec3 flat_axis(uint kind, uint layer)
{
    vec2 turned = layer == 0u   ? constants.flat_axis_0
                  : layer == 1u ? constants.flat_axis_1
                                : constants.flat_axis_2;
    vec2 form = layer == 0u ? vec2(1.0, 0.0) : layer == 1u ? vec2(0.0, 1.0) : vec2(1.0, 1.0);
    return vec3(kind == STROKES_FORM ? form : turned, 0.0);
}

bool is_flat(uint kind)
{
    return kind == STROKES_UV || kind == STROKES_FORM || kind == STROKES_PAGE;
}

LineField field_along(vec3 axis, vec3 side, vec3 other, vec3 p, Footprint f)
{
    vec2 across = vec2(dot(axis, f.dx), dot(axis, f.dy));
    LineField field;
    field.v = dot(axis, p);
    field.v_per_px = length(across);
    vec2 along = vec2(-across.y, across.x) / max(field.v_per_px, 1e-20);
    float side_rate = dot(vec2(dot(side, f.dx), dot(side, f.dy)), along);
    float other_rate = dot(vec2(dot(other, f.dx), dot(other, f.dy)), along);
    bool take_side = abs(side_rate) >= abs(other_rate);
    field.wander = vec2(dot(side, p), dot(other, p));
    field.u = take_side ? field.wander.x : field.wander.y;
    field.u_per_px = max(abs(side_rate), abs(other_rate));
    field.wraps = false;
    return field;
}

// Families of strokes, two a layer, and what each has to draw. The shares are such that what the families
// leave white multiplies to what the darkness leaves white.
struct Families {
    uint next;
    float remaining; // darkness that the layers to come have to draw
    float share;     // darkness of the layer in hand
};

// What a layer draws of the darkness that is left to do; the last one draws all of it.
float layer_share(uint layer, float remaining)
{
    return layer + 1u >= constants.layers ? remaining : min(remaining, layer == 0u ? 0.46 : 0.50);
}

// Goes on to the next family that has anything to draw, and returns its darkness; 0 when none is left.
float next_family(inout Families families, vec3 normal, uint kind, out uint family)
{
    float dark = 0.0;
    family = 0u;
    while (dark < 0.002 && families.next < 2u * constants.layers && families.remaining > 1e-4) {
        family = families.next++;
        uint layer = family >> 1;
        bool is_level = (family & 1u) != 0u;
        families.share = is_level ? families.share : layer_share(layer, families.remaining);
        float slices =
            is_flat(kind) ? 1.0 : smoothstep(0.50, 0.68, length(cross(solid_axis(kind, 2u * layer), normal)));
        dark = 1.0 - pow(1.0 - families.share, is_level ? 1.0 - slices : slices);
        if (is_level) {
            families.remaining = 1.0 - (1.0 - families.remaining) / max(1.0 - families.share, 1e-6);
        }
    }
    return dark < 0.002 ? 0.0 : dark;
}

float strokes(vec3 p, Footprint f, vec3 normal, uint kind, float dark)
{
    LineLook look = LineLook(constants.width_px, constants.wobble_px, constants.gap_px, constants.taper_px,
                             constants.cell_px, constants.pressure, has_growth ? constants.growth : 0.0);
    Families families = Families(0u, dark, 0.0);
    float white = 1.0;
    uint family;
    float family_dark = next_family(families, normal, kind, family);
    while (family_dark > 0.0) {
        vec3 axis = is_flat(kind) ? flat_axis(kind, family >> 1) : solid_axis(kind, family);
        vec3 side =
            is_flat(kind)
                ? vec3(axis.y, -axis.x, 0.0)
                : normalize(cross(axis, abs(axis.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
        LineField field = field_along(axis, side, cross(axis, side), p, f);
        field.wraps = kind == STROKES_FORM;
        field.wander = kind == STROKES_FORM ? vec2(0.0) : field.wander;
        white *= 1.0 - line_ink(field, look, family_dark, hash(constants.seed * 64u + family));
        family_dark = next_family(families, normal, kind, family);
    }
    return 1.0 - white;
}

// The pixel whose strokes are drawn here: itself, or one nearby whose strokes run over onto bare paper. Then
// `share` tells how much of its darkness is left.
ivec2 source_of(ivec2 pixel, out float share)
{
    share = 1.0;
    if (!has_overrun || !is_paper(texelFetch(draw_image, pixel, 0).x) ||
        texelFetch(darkness_image, pixel, 0).x > 0.0) {
        return pixel;
    }
    uint source = texelFetch(source_image, pixel, 0).x;
    ivec2 at = ivec2(source & 0xffffu, source >> 16);
    float away = distance(vec2(pixel), vec2(at));
    share = source == NO_SOURCE ? 0.0 : 1.0 - smoothstep(0.3, 1.0, away / constants.overrun_px);
    return source == NO_SOURCE ? pixel : at;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float share;
    ivec2 source = source_of(pixel, share);
    vec2 beyond = vec2(pixel - source);
    float dark = texelFetch(darkness_image, source, 0).x * share;
    uint kind = strokes_of(texelFetch(draw_image, source, 0).x);
    Footprint f = unpack_footprint(texelFetch(footprint_image, source, 0));
    vec3 p = texelFetch(coordinate_image, source, 0).xyz + f.dx * beyond.x + f.dy * beyond.y;
    vec3 normal = unpack_normal(texelFetch(normal_image, source, 0).y);
    float ink = strokes(p, f, normal, kind, dark);
    ink = max(ink,
              source == pixel ? smoothstep(constants.black_above, constants.black_above + 0.02, dark) : 0.0);
    imageStore(out_ink, pixel, vec4(ink));
}
