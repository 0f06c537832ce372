// SPDX-License-Identifier: MIT
// One thread per pixel: the share of the sun that the ground leaves visible.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/sun_disc.glsl"
#include "techniques/shadow/ground/ground_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
// Heights of the ground fields, and horizons or shares of the sun, in the format of ground_keep.comp.
layout(binding = 2) uniform usamplerBuffer kept;
layout(binding = 3, r16f) writeonly uniform image2D out_share;

layout(constant_id = 0) const uint variant = 0u;

const bool keeps_shares = (variant & ground_keeps_shares) != 0u;

layout(push_constant, scalar) uniform Constants
{
    GroundShareConstants constants;
};

vec2 kept_at(uint level, ivec2 texel)
{
    uint first = level * constants.size * constants.size;
    return unpackHalf2x16(texelFetch(kept, int(first) + texel.y * int(constants.size) + texel.x).x);
}

// Interpolated height and horizon (or share of the sun) of the ground, from the finest field that contains
// the place. Outside all fields all of the sun is visible.
vec2 ground_at(vec2 place)
{
    int chosen = -1;
    vec2 at = vec2(0.0);
    for (int level = int(ground_levels) - 1; level >= 0; --level) {
        GroundLevel field = constants.levels[level];
        vec2 here = (place - field.origin_m) / field.texel_m;
        bool is_inside =
            all(greaterThanEqual(here, vec2(0.0))) && all(lessThan(here, vec2(constants.size - 1u)));
        chosen = is_inside ? level : chosen;
        at = is_inside ? here : at;
    }
    uint level = uint(max(chosen, 0));
    ivec2 texel = ivec2(at);
    vec2 f = at - vec2(texel);
    vec2 found = mix(mix(kept_at(level, texel), kept_at(level, texel + ivec2(1, 0)), f.x),
                     mix(kept_at(level, texel + ivec2(0, 1)), kept_at(level, texel + ivec2(1, 1)), f.x), f.y);
    return chosen < 0 ? vec2(-1e4, keeps_shares ? 1.0 : -1.0) : found;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float depth = texelFetch(depth_image, pixel, 0).x;
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9));
    vec3 sun = constants.towards_sun;
    vec2 ground = ground_at(point.xz);
    // A point above the ground is lit like the ground point at which its sun ray, extended downwards, ends.
    vec2 back_per_m = sun.xz / max(sun.y, 0.01);
    float above = max(point.y - ground.x - 0.1, 0.0);
    int tries = above > 0.0 && depth > 0.0 ? 2 : 0;
    for (int i = 0; i < tries; ++i) {
        ground = ground_at(point.xz - back_per_m * above);
        above = max(point.y - ground.x - 0.1, 0.0);
    }
    float share = keeps_shares                    ? ground.y
                  : sun.y > -constants.radius_rad ? share_of_disc(ground.y / constants.radius_rad)
                                                  : 0.0;
    imageStore(out_share, pixel, vec4(depth > 0.0 ? share : 1.0));
}
