// SPDX-License-Identifier: MIT
// One thread a pixel: how dark the strokes there have to be.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/draw_word.glsl"
#include "shaders/tone.glsl"
#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D color_image;
layout(binding = 4) uniform sampler2D light_image;
layout(binding = 5) uniform sampler2D screen_image;
layout(binding = 6, r16f) writeonly uniform image2D out_darkness;

layout(push_constant, scalar) uniform Constants
{
    DarknessConstants constants;
};

// Bit 0: darkness fades with distance. Bit 1: there are see-through surfaces.
layout(constant_id = 0) const uint variant = 0u;
const bool has_fade = (variant & 1u) != 0u;
const bool has_screen = (variant & 2u) != 0u;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    vec4 color = texelFetch(color_image, pixel, 0);
    float light = occluded(constants.tone, texelFetch(light_image, pixel, 0).a, color.a);
    float dark = darkness(constants.tone, light, luminance(color.rgb * color.rgb));
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
    imageStore(out_darkness, pixel, vec4(dark));
}
