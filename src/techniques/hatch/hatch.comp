// SPDX-License-Identifier: MIT
// One thread inks one pixel: light becomes darkness, darkness is shared among layers of strokes, and what the layers
// leave white multiplies.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/footprint.glsl"
#include "shaders/mesh.glsl.h"
#include "shaders/octahedral.glsl"
#include "shaders/tone.glsl"
#include "techniques/hatch/hatch.glsl.h"
#include "shaders/lines.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame { FrameGlobals frame; };
layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D normal_image;
layout(binding = 4) uniform sampler2D color_image;
layout(binding = 5) uniform sampler2D coordinate_image;
layout(binding = 6) uniform usampler2D footprint_image;
layout(binding = 7) uniform sampler2D light_image;
layout(scalar, binding = 8) readonly buffer Draws { DrawRecord draws[]; };
layout(binding = 9, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants { HatchConstants constants; };

const uint max_layers = 3u;

// Each layer slices the solid by parallel planes; where a surface lies nearly in such a plane, a second family takes over.
const vec3 slice_axis[max_layers] = vec3[](vec3(0.30, 0.90, -0.32), vec3(0.80, 0.42, 0.43), vec3(-0.62, 0.52, 0.59));
const vec3 level_axis[max_layers] = vec3[](vec3(0.36, 0.05, 0.93), vec3(0.88, -0.06, -0.47), vec3(0.72, 0.04, 0.69));
const float uv_turn_rad[max_layers] = float[](0.0, 1.05, -0.70);

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
    field.u = take_side ? dot(side, p) : dot(other, p);
    field.u_per_px = max(abs(side_rate), abs(other_rate));
    field.wander = vec2(dot(side, p), dot(other, p));
    return field;
}

LineLook look_here()
{
    return LineLook(constants.width_px, constants.wobble_px, constants.gap_px, constants.taper_px, constants.cell_px,
                    constants.pressure);
}

float axis_ink(vec3 axis, vec3 p, Footprint f, float dark, uint seed)
{
    vec3 side = normalize(cross(axis, abs(axis.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
    return line_ink(field_along(axis, side, cross(axis, side), p, f), look_here(), dark, seed);
}

float solid_layer(uint layer, vec3 p, Footprint f, vec3 normal, float dark, uint seed)
{
    vec3 axis = normalize(slice_axis[layer]);
    float tilt = length(cross(axis, normal));
    float slices = smoothstep(0.42, 0.62, tilt);
    float white = 1.0;
    if (slices > 0.0) {
        white *= 1.0 - axis_ink(axis, p, f, 1.0 - pow(1.0 - dark, slices), hash(seed, layer));
    }
    if (slices < 1.0) {
        white *= 1.0 - axis_ink(normalize(level_axis[layer]), p, f, 1.0 - pow(1.0 - dark, 1.0 - slices), hash(seed, layer + 8u));
    }
    return 1.0 - white;
}

float uv_layer(uint layer, vec3 p, Footprint f, float dark, uint seed)
{
    float turn = uv_turn_rad[layer] + constants.slant_rad;
    vec3 axis = vec3(-sin(turn), cos(turn), 0.0);
    return line_ink(field_along(axis, vec3(axis.y, -axis.x, 0.0), vec3(0.0), p, f), look_here(), dark, hash(seed, layer));
}

// What a layer draws of the darkness that the layers before it have left to do; the last one draws all of it.
float layer_share(uint layer, float remaining)
{
    const float most[max_layers] = float[](0.46, 0.50, 1.0);
    return layer + 1u >= constants.layers ? remaining : min(remaining, most[layer]);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint draw = texelFetch(draw_image, pixel, 0).x;
    float ink = 0.0;
    if (draw != 0u) {
        vec3 color = texelFetch(color_image, pixel, 0).rgb;
        float dark = darkness(constants.tone, texelFetch(light_image, pixel, 0).a, luminance(color * color));
        if (constants.fade < 1.0) {
            float away = distance(anchor_at(frame, vec2(pixel) + 0.5, max(texelFetch(depth_image, pixel, 0).x, 1e-9)),
                                  frame.eye_anchor);
            dark *= mix(constants.fade, 1.0, exp2(-away / constants.fade_distance_m));
        }
        vec3 p = texelFetch(coordinate_image, pixel, 0).xyz;
        Footprint f = unpack_footprint(texelFetch(footprint_image, pixel, 0));
        vec3 normal = octahedral_decode(texelFetch(normal_image, pixel, 0).zw);
        bool by_uv = draws[draw - 1u].strokes_follow_uv != 0u;
        float remaining = dark;
        float white = 1.0;
        for (uint layer = 0u; layer < constants.layers && remaining > 0.0; ++layer) {
            float share = layer_share(layer, remaining);
            white *= 1.0 - (by_uv ? uv_layer(layer, p, f, share, constants.seed) : solid_layer(layer, p, f, normal, share, constants.seed));
            remaining = 1.0 - (1.0 - remaining) / max(1.0 - share, 1e-6);
            remaining = remaining < 1e-4 ? 0.0 : remaining;
        }
        ink = max(1.0 - white, smoothstep(constants.black_above, constants.black_above + 0.02, dark));
    }
    imageStore(out_ink, pixel, vec4(ink));
}
