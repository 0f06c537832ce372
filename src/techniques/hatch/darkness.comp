// SPDX-License-Identifier: MIT
// One thread handles one pixel: it computes the darkness that the strokes must reach, and sets the ink to
// blank. Each workgroup lists its tile of pixels if the tile has any darkness.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/halo.glsl.h"
#include "shaders/level.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/tone.glsl"
#include "shaders/unit.glsl"
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
layout(binding = 7, r16f) writeonly uniform image2D out_ink;

#define DARK_TILES_BINDING 8
#include "techniques/hatch/dark_tiles.glsl"

// Number of the style variant (the style of certain materials or objects) of each draw call.
layout(binding = 9) uniform usamplerBuffer variant_texels;

// Visible share of the sun, negative where the surface turns away from the sun.
layout(binding = 10) uniform sampler2D sun_image;
layout(binding = 11) uniform usampler2D normal_image;
layout(binding = 12) uniform sampler2D halo_image; // distances to things, only with darkness_has_halo

layout(push_constant, scalar) uniform Constants
{
    DarknessConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_fade = (variant & darkness_has_fade) != 0u;
const bool has_screen = (variant & darkness_has_screen) != 0u;
const bool has_variants = (variant & darkness_has_variants) != 0u;
const bool has_causes = (variant & darkness_has_causes) != 0u;
const bool keeps_ink = (variant & darkness_keeps_ink) != 0u;
const bool is_grouped = (variant & darkness_is_grouped) != 0u;
const bool has_halo = (variant & darkness_has_halo) != 0u;

// A surface counts as facing down from this height of its normal, on its negative side.
const float least_under = 0.3;
const float most_under = 0.7;
// Darkness from which a surface that the sun does not reach counts as shade: lamps may light it.
const float least_shade = 0.3;
const float most_shade = 0.6;

vec3 normal_at(ivec2 pixel)
{
    return unpack_normal(texelFetch(normal_image, pixel, 0).y);
}

// Degree to which a pixel of the darkness `dark` is in shade. Without a sun, all that is dark is shade.
float shade_at(float sun, float dark)
{
    return (1.0 - max(sun, 0.0)) * smoothstep(least_shade, most_shade, dark);
}

// How many layers of ink replace one layer of the hatching at a pixel.
float layers_at(ivec2 pixel, uint word, float dark)
{
    vec3 normal = normal_at(pixel);
    float sun = texelFetch(sun_image, pixel, 0).x;
    bool on_ground = is_ground(word, constants.ground_draws);
    float level = on_ground ? 1.0 : smoothstep(least_level, most_level, normal.y);
    float under = on_ground ? 0.0 : smoothstep(least_under, most_under, -normal.y);
    float of_shade = sun < 0.0 && !on_ground ? constants.form_shade : constants.cast_shade;
    of_shade *= mix(1.0, constants.under_shade, under);
    return mix(1.0, of_shade, shade_at(sun, dark)) * mix(1.0, constants.ground_shade, level);
}

// Share of the darkness that remains at a pixel of the ground, or of a plane like the ground, around things.
float left_around_things(ivec2 pixel, uint word, float dark)
{
    float left = left_in_halo(halo_image, vec2(pixel) + 0.5, frame.tile_from_px, constants.halo_px);
    if (left == 1.0) {
        return 1.0;
    }
    vec3 beside = normal_at(min(pixel + 2, ivec2(frame.size_px) - 1));
    bool is_open = is_ground(word, constants.ground_draws) || is_flat_and_level(normal_at(pixel), beside);
    float sun = has_causes ? texelFetch(sun_image, pixel, 0).x : 0.0;
    return is_open ? mix(left, 1.0, shade_at(sun, dark)) : 1.0;
}

// Darkness of `count` layers of hatching, each of the darkness `dark`. More layers are laid as on a white
// material, with the darkness `white`: on a dark material, its texture would be lost in black.
float in_layers(float dark, float white, float count)
{
    float layered = 1.0 - pow(1.0 - min(count > 1.0 ? white : dark, 0.9999), count);
    return count > 1.0 ? max(dark, layered) : layered;
}

float darkness_at(ivec2 pixel)
{
    uint word = texelFetch(draw_image, pixel, 0).x;
    vec4 color = texelFetch(color_image, pixel, 0);
    float light = occluded(constants.tone, texelFetch(light_image, pixel, 0).a, color.a);
    float dark = darkness(constants.tone, light, luminance(color.rgb * color.rgb));
    float left = has_halo && sees_draw(word) ? left_around_things(pixel, word, dark) : 1.0;
    if (has_causes && sees_draw(word)) {
        dark = in_layers(dark, darkness(constants.tone, light, 1.0), layers_at(pixel, word, dark));
    }
    dark *= left;
    if (has_fade) {
        float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
        float away = distance(anchor_at(frame, vec2(pixel) + 0.5, depth), frame.eye_anchor);
        dark *= mix(constants.fade, 1.0, exp2(-away / constants.fade_distance_m));
    }
    const float no_surface = is_grouped ? not_hatched : 0.0;
    dark = sees_draw(word) ? dark : no_surface;
    if (has_screen) {
        // A surface behind a transparent surface is drawn lighter, as if the surface were seen through
        // tracing paper. The darkness values of both surfaces are mixed.
        vec4 screen = texelFetch(screen_image, pixel, 0);
        float own = 0.6 * (1.0 - luminance(screen.rgb * screen.rgb));
        dark = sees_draw(word) ? mix(dark, own, 0.7 * screen.a) : no_surface;
    }
    if (constants.group_count > 0u && sees_draw(word)) {
        float tone = tone_of_group(group_of(dark, constants.group_count), constants.group_count);
        dark = mix(dark, tone, constants.group_strength);
    }
    if (has_variants && sees_draw(word)) {
        dark =
            texelFetch(variant_texels, int(draw_of(word))).x == constants.style_variant ? dark : no_surface;
    }
    return dark;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool on_page = all(lessThan(uvec2(pixel), frame.size_px));
    float dark = on_page ? darkness_at(pixel) : 0.0;
    if (!is_grouped) {
        list_dark_tile(dark);
    }
    if (on_page) {
        imageStore(out_darkness, pixel, vec4(dark));
        if (!keeps_ink) {
            imageStore(out_ink, pixel, vec4(0.0));
        }
    }
}
