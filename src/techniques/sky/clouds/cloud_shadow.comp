// SPDX-License-Identifier: MIT
// One thread computes, for one pixel, the share of sunlight that clouds let through to the visible surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/loops.glsl"
#include "techniques/sky/sky.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Clouds
{
    CloudGlobals clouds;
};

layout(binding = 2) uniform usamplerBuffer start_texels;
layout(binding = 3) uniform samplerBuffer puff_texels;
layout(binding = 4) uniform sampler2D depth_image;
// Share of sunlight that other objects let through; only with clouds_have_share.
layout(binding = 5) uniform sampler2D share_image;
layout(binding = 6, r16f) writeonly uniform image2D out_share;

layout(push_constant, scalar) uniform Constants
{
    CloudShadow shadow;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_share = (variant & clouds_have_share) != 0u;

#include "techniques/sky/clouds/puffs.glsl"

// Sine of the sun's lowest elevation; shadows of a lower sun are too long to be distinguished.
const float lowest_sun = 0.05;
const float penumbra_rad = 0.01; // about the angular diameter of the sun: the width of a shadow's soft edge

// Rotates a world vector to the wind's axes: along the wind, up, across the wind.
vec3 in_wind(vec3 d)
{
    vec2 along = clouds.along_wind;
    return vec3(dot(d.xz, along), d.y, d.z * along.x - d.x * along.y);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float depth = texelFetch(depth_image, pixel, 0).x;
    float share = has_share ? texelFetch(share_image, pixel, 0).x : 1.0;
    if (depth > 0.0 && clouds.towards_sun.y > lowest_sun) {
        vec3 from_eye = in_wind(anchor_at(frame, vec2(pixel) + 0.5, depth) - frame.eye_anchor);
        for (int i = 0; i < loop_rounds(int(clouds.puff_layer_count), pixel.x); ++i) {
            PuffLayer layer = clouds.puffs[i];
            layer.base_m -= from_eye.y;
            layer.eye += from_eye * layer.per_m;
            float cover =
                layer.base_m > 0.0 ? puffs_along(layer, clouds.towards_sun, penumbra_rad).cover : 0.0;
            share *= 1.0 - shadow.strength * cover;
        }
    }
    imageStore(out_share, pixel, vec4(share));
}
