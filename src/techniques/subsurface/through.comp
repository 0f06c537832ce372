// SPDX-License-Identifier: MIT
// One thread a pixel of the listed tiles adds the light that falls on the far side of what is seen, as far as
// the thickness lets it through.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/tile_list.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image; // of what light may come through; 0 elsewhere
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D exit_image; // depth of the far side
layout(binding = 4) uniform sampler2D far_light_image;

#define LOOKS_BINDING 5
#define HAS_LOOKS ((variant & subsurface_has_looks) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/looks.glsl"

layout(binding = 7, rgba16f) uniform image2D light; // irradiance / pi; its luminance in alpha

layout(scalar, binding = 8) readonly buffer Tiles
{
    uint tiles[]; // see tile_list.glsl.h
};

#include "techniques/subsurface/thickness.glsl"

const float most_light = 65504.0; // that half floats hold

void main()
{
    uint number = gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x;
    if (number >= tiles[tile_list_count]) {
        return;
    }
    uint tile = tiles[tile_list_first + number];
    ivec2 pixel = ivec2(8u * uvec2(tile & 0xffffu, tile >> 16) + gl_LocalInvocationID.xy);
    uint word = texelFetch(draw_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px)) || word == 0u) {
        return;
    }
    uint look = look_of(word);
    vec4 through = look_through(look);
    float inside_m = thickness_m(vec2(pixel) + 0.5, texelFetch(depth_image, pixel, 0).x,
                                 texelFetch(exit_image, pixel, 0).x, look_scatter(look).a);
    vec3 left = through.a * exp(-through.rgb * inside_m);
    vec3 sum = imageLoad(light, pixel).rgb + left * texelFetch(far_light_image, pixel, 0).rgb;
    sum = min(sum, vec3(most_light));
    imageStore(light, pixel, vec4(sum, luminance(sum)));
}
