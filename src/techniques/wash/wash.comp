// SPDX-License-Identifier: MIT
// One thread per pixel applies the wash: a flat colour per material, which is cooler and deeper in shadow,
// and paler with distance. Writes the transmittance of the paint (1: bare paper).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/noise.glsl"
#include "shaders/shade.glsl.h"
#include "shaders/tone.glsl"
#include "techniques/wash/wash.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D color_image;
layout(binding = 4) uniform sampler2D light_image;

#define DRAW_TEXELS_BINDING 5
#include "shaders/draw_texels.glsl"

#define MATERIAL_TEXELS_BINDING 6
#include "shaders/material_texels.glsl"

layout(binding = 7) uniform sampler2D background_image;
layout(binding = 8) uniform sampler2D screen_image;
layout(binding = 9, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 10) uniform usamplerBuffer variant_texels; // style variant of each draw call

// Linear colour in the shade; alpha as in shaders/shade.glsl.h.
layout(binding = 11) uniform sampler2D shade_image;

layout(push_constant, scalar) uniform Constants
{
    WashConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_air = (variant & wash_has_air) != 0u;
const bool has_screen = (variant & wash_has_screen) != 0u;
const bool has_background = (variant & wash_has_background) != 0u;
const bool is_of_one_variant = (variant & wash_is_of_one_variant) != 0u;
const bool keeps_cover = (variant & wash_keeps_cover) != 0u;
const bool has_shade = (variant & wash_has_shade) != 0u;

// The paint for a colour: the style's saturation, dark colours lifted, and greys paler.
vec3 paint_of(vec3 color)
{
    color = mix(vec3(luminance(color)), color, constants.saturation);
    float largest = max(max(color.r, color.g), max(color.b, 1e-3));
    float saturation = 1.0 - min(color.r, min(color.g, color.b)) / largest;
    // Dark colours are painted pale, because strokes show how dark an object is.
    float brightness = luminance(color);
    float lifted = length(vec2(brightness, constants.least));
    color = min((color + 1e-4) * (lifted / (brightness + 1e-4)), vec3(1.0));
    return mix(vec3(1.0), color, mix(constants.neutral, 1.0, smoothstep(0.0, 0.3, saturation)));
}

float darkness_at(ivec2 pixel)
{
    float open = texelFetch(color_image, pixel, 0).a;
    return darkness(constants.tone, occluded(constants.tone, texelFetch(light_image, pixel, 0).a, open), 1.0);
}

struct Darkness {
    float here;
    float steepness; // increase of darkness from pixel to pixel; known only near the shadow's edge
};

bool is_near_edge(float dark)
{
    return abs(dark - constants.shadow_from) < constants.softness + 0.026;
}

// Darkness of a pixel and its change to the neighbours. Of the differences to the two neighbours along an
// axis, the smaller is used, because one neighbour may belong to another surface. One loop covers the pixel
// and its neighbours; most subgroups leave the loop after the first iteration.
Darkness darkness_around(ivec2 pixel)
{
    ivec2 last = ivec2(frame.size_px) - 1;
    float here = 0.0;
    vec2 rise = vec2(1e9);
    int i = 0;
    do {
        ivec2 aside = i == 0   ? ivec2(0)
                      : i == 1 ? ivec2(-1, 0)
                      : i == 2 ? ivec2(0, -1)
                      : i == 3 ? ivec2(1, 0)
                               : ivec2(0, 1);
        float dark = darkness_at(clamp(pixel + aside, ivec2(0), last));
        here = i == 0 ? dark : here;
        float difference = abs(dark - here);
        rise = min(rise, i == 0 ? rise : (i & 1) != 0 ? vec2(difference, rise.y) : vec2(rise.x, difference));
        ++i;
    } while (subgroupAny(i < 5 && is_near_edge(here)));
    return Darkness(here, length(rise));
}

// Paint for a colour that is printed in one ink. The share of the ink is even to the eye: it follows the
// square root of the colour's brightness.
vec3 printed(vec3 color)
{
    vec3 spot = mix(constants.spot_color, vec3(1.0), sqrt(clamp(luminance(color), 0.0, 1.0)));
    return mix(color, spot, constants.spot);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    if (is_of_one_variant &&
        (!sees_draw(word) || texelFetch(variant_texels, int(draw_of(word))).x != constants.style_variant)) {
        return;
    }
    vec3 through = vec3(1.0);
    if (has_background) {
        through =
            printed(texelFetch(background_image, min(pixel, textureSize(background_image, 0) - 1), 0).rgb);
    }
    if (sees_draw(word)) {
        uint material = draw_at(draw_of(word)).material;
        vec4 stored = texelFetch(color_image, pixel, 0);
        vec3 color = paint_of(mix(mean_color_of(material), stored.rgb * stored.rgb, constants.detail));
        vec4 light = texelFetch(light_image, pixel, 0);
        Darkness dark = darkness_around(pixel);
        // The shadow's edge wavers a little, like an edge painted with a wet brush. Where light falls off
        // slowly, the waver is limited, so that the edge does not break into spots.
        float waver = 0.0;
        if (is_near_edge(dark.here)) {
            float grain_px = 0.9 * frame.pixels_per_mm;
            float most = min(0.05, dark.steepness * max(grain_px, 1.0));
            waver = most * (value_noise(page_place(frame, vec2(pixel)) / grain_px, 5u) - 0.5);
        }
        float shadow = smoothstep(constants.shadow_from - constants.softness,
                                  constants.shadow_from + constants.softness, dark.here + waver);
        vec3 tint = constants.shadow_tint * shade_color_of(material);
        if (has_shade) {
            vec4 shade = texelFetch(shade_image, pixel, 0);
            bool is_there = shade.a != shade_absent;
            shadow = is_there && shade.a != shade_by_wash ? 1.0 - shade.a : shadow;
            color = is_there ? mix(color, paint_of(shade.rgb), shadow) : color;
            tint = is_there ? vec3(1.0) : tint;
        }
        vec3 hue = (light.rgb + 1e-3) / (light.a + 1e-3); // the small addend keeps black light without a hue
        // Paint that should be nearly grey takes no hue from coloured light.
        float hue_share = 0.5 * smoothstep(0.0, 0.2, constants.saturation);
        color *= mix(vec3(1.0), tint, shadow) * mix(vec3(1.0), hue, hue_share) *
                 mix(vec3(1.0), light_tint(light.rgb), constants.light_tint);
        if (is_paper(word)) {
            color = mix(vec3(1.0), mix(vec3(1.0), constants.shadow_tint, constants.ground_shadow), shadow);
        }
        if (has_air && !is_paper(word)) {
            float away =
                distance(anchor_at(frame, vec2(pixel) + 0.5, max(texelFetch(depth_image, pixel, 0).x, 1e-9)),
                         frame.eye_anchor);
            color = mix(color, constants.air_color,
                        constants.air * (1.0 - exp2(-away / constants.air_distance_m)));
        }
        through = mix(vec3(1.0), printed(clamp(color, 0.0, 1.0)), constants.strength);
    }
    float cover = sees_draw(word) && !(keeps_cover && is_paper(word)) ? 1.0 : 0.0;
    if (has_screen) {
        vec4 screen = texelFetch(screen_image, pixel, 0);
        through =
            mix(through, mix(vec3(1.0), printed(screen.rgb * screen.rgb), constants.strength), screen.a);
        cover = keeps_cover ? mix(cover, 1.0, screen.a) : cover;
    }
    imageStore(out_wash, pixel, vec4(through, cover));
}
