// SPDX-License-Identifier: MIT
// One thread inks one pixel: light becomes darkness, darkness is shared among layers of strokes, and what the
// layers leave white multiplies.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/draw_word.glsl"
#include "shaders/footprint.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/tone.glsl"
#include "techniques/hatch/hatch.glsl.h"
#include "shaders/lines.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform usampler2D normal_image;
layout(binding = 4) uniform sampler2D color_image;
layout(binding = 5) uniform sampler2D coordinate_image;
layout(binding = 6) uniform usampler2D footprint_image;
layout(binding = 7) uniform sampler2D light_image;
layout(binding = 8) uniform sampler2D screen_image;
layout(binding = 9, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    HatchConstants constants;
};

// Bit 0: darkness fades with distance. Bit 1: there are see-through surfaces.
layout(constant_id = 0) const uint variant = 0u;
const bool has_fade = (variant & 1u) != 0u;
const bool has_screen = (variant & 2u) != 0u;

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

vec2 uv_axis(uint layer)
{
    return layer == 0u ? constants.uv_axis_0 : layer == 1u ? constants.uv_axis_1 : constants.uv_axis_2;
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
float next_family(inout Families families, vec3 normal, bool by_uv, out uint family)
{
    float dark = 0.0;
    family = 0u;
    while (dark < 0.002 && families.next < 2u * constants.layers && families.remaining > 1e-4) {
        family = families.next++;
        uint layer = family >> 1;
        bool is_level = (family & 1u) != 0u;
        families.share = is_level ? families.share : layer_share(layer, families.remaining);
        float slices = by_uv ? 1.0 : smoothstep(0.50, 0.68, length(cross(slice_axis(layer), normal)));
        dark = 1.0 - pow(1.0 - families.share, is_level ? 1.0 - slices : slices);
        if (is_level) {
            families.remaining = 1.0 - (1.0 - families.remaining) / max(1.0 - families.share, 1e-6);
        }
    }
    return dark < 0.002 ? 0.0 : dark;
}

float hatch(vec3 p, Footprint f, vec3 normal, bool by_uv, float dark)
{
    LineLook look = LineLook(constants.width_px, constants.wobble_px, constants.gap_px, constants.taper_px,
                             constants.cell_px, constants.pressure);
    Families families = Families(0u, dark, 0.0);
    float white = 1.0;
    uint family;
    float family_dark = next_family(families, normal, by_uv, family);
    while (family_dark > 0.0) {
        vec2 over_uv = uv_axis(family >> 1);
        vec3 solid = (family & 1u) != 0u ? level_axis(family >> 1) : slice_axis(family >> 1);
        vec3 axis = by_uv ? vec3(over_uv, 0.0) : solid;
        vec3 side =
            by_uv ? vec3(over_uv.y, -over_uv.x, 0.0)
                  : normalize(cross(axis, abs(axis.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
        LineField field = field_along(axis, side, cross(axis, side), p, f);
        white *= 1.0 - line_ink(field, look, family_dark, hash(constants.seed * 64u + family));
        family_dark = next_family(families, normal, by_uv, family);
    }
    return 1.0 - white;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    vec3 color = texelFetch(color_image, pixel, 0).rgb;
    float dark = darkness(constants.tone, texelFetch(light_image, pixel, 0).a, luminance(color * color));
    if (has_fade) {
        float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
        float away = distance(anchor_at(frame, vec2(pixel) + 0.5, depth), frame.eye_anchor);
        dark *= mix(constants.fade, 1.0, exp2(-away / constants.fade_distance_m));
    }
    dark = sees_draw(word) ? dark : 0.0;
    if (has_screen) {
        // What is behind pales as under tracing paper, and the screen's own darkness takes its place.
        vec4 screen = texelFetch(screen_image, pixel, 0);
        float own = 0.6 * (1.0 - luminance(screen.rgb * screen.rgb));
        dark = sees_draw(word) ? mix(dark, own, 0.7 * screen.a) : 0.0;
    }
    vec3 p = texelFetch(coordinate_image, pixel, 0).xyz;
    Footprint f = unpack_footprint(texelFetch(footprint_image, pixel, 0));
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
    float ink = hatch(p, f, normal, (word & DRAW_FOLLOWS_UV) != 0u, dark);
    ink = max(ink, smoothstep(constants.black_above, constants.black_above + 0.02, dark));
    imageStore(out_ink, pixel, vec4(ink));
}
