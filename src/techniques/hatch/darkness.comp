// SPDX-License-Identifier: MIT
// One thread handles one pixel. The thread computes the darkness that the strokes must reach at the pixel,
// and initializes the pixel's ink to blank. The shader also lists the tiles that have any darkness. The
// threads of a tile share results through subgroup operations, because barriers are slow on CPU devices.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
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

// A list of the tiles of 8 x 8 pixels that are not entirely blank, in any order. The list follows the
// arguments of an indirect dispatch with one workgroup per tile.
struct DarkTile {
    // Entry n holds the position of the n-th listed tile: the tile's column in the lower 16 bits, its row in
    // the upper 16 bits.
    uint place;
    uint is_listed; // in entry n: 1 if the n-th tile of the page, row by row, is already listed
};

layout(scalar, binding = 8) buffer DarkTiles
{
    uvec4 tile_groups;
    DarkTile dark_tiles[];
};

// Number of the style variant (the style of certain materials or objects) of each draw call.
layout(binding = 9) uniform usamplerBuffer variant_texels;

// Visible share of the sun, negative where the surface turns away from the sun.
layout(binding = 10) uniform sampler2D sun_image;
layout(binding = 11) uniform usampler2D normal_image;

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

// Height of the normal from which a surface counts as level, like the ground.
const float least_level = 0.8;
const float most_level = 0.95;
// Darkness from which a surface that the sun does not reach counts as shade: lamps may light it.
const float least_shade = 0.3;
const float most_shade = 0.6;

// How many layers of ink replace one layer of the hatching at a pixel.
float layers_at(ivec2 pixel, uint draw, float dark)
{
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
    float sun = texelFetch(sun_image, pixel, 0).x;
    bool is_ground = any(equal(uvec2(draw), constants.ground_draws));
    float level = is_ground ? 1.0 : smoothstep(least_level, most_level, normal.y);
    float of_shade = sun < 0.0 && !is_ground ? constants.form_shade : constants.cast_shade;
    float shade = (1.0 - max(sun, 0.0)) * smoothstep(least_shade, most_shade, dark);
    return mix(1.0, of_shade, shade) * mix(1.0, constants.ground_shade, level);
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
    if (has_causes && sees_draw(word)) {
        dark = in_layers(dark, darkness(constants.tone, light, 1.0), layers_at(pixel, draw_of(word), dark));
    }
    if (has_fade) {
        float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
        float away = distance(anchor_at(frame, vec2(pixel) + 0.5, depth), frame.eye_anchor);
        dark *= mix(constants.fade, 1.0, exp2(-away / constants.fade_distance_m));
    }
    dark = sees_draw(word) ? dark : 0.0;
    if (has_screen) {
        // A surface behind a transparent surface is drawn lighter, as if the surface were seen through
        // tracing paper. The darkness values of both surfaces are mixed.
        vec4 screen = texelFetch(screen_image, pixel, 0);
        float own = 0.6 * (1.0 - luminance(screen.rgb * screen.rgb));
        dark = sees_draw(word) ? mix(dark, own, 0.7 * screen.a) : 0.0;
    }
    if (has_variants && sees_draw(word)) {
        dark = texelFetch(variant_texels, int(draw_of(word))).x == constants.style_variant ? dark : 0.0;
    }
    return dark;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool on_page = all(lessThan(uvec2(pixel), frame.size_px));
    float dark = on_page ? darkness_at(pixel) : 0.0;
    if (subgroupAny(dark > 0.0) && subgroupElect()) {
        uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        if (atomicExchange(dark_tiles[tile].is_listed, 1u) == 0u) {
            dark_tiles[atomicAdd(tile_groups.x, 1u)].place = gl_WorkGroupID.y << 16 | gl_WorkGroupID.x;
        }
    }
    if (on_page) {
        imageStore(out_darkness, pixel, vec4(dark));
        if (!keeps_ink) {
            imageStore(out_ink, pixel, vec4(0.0));
        }
    }
}
