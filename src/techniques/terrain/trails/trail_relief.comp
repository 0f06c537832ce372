// SPDX-License-Identifier: MIT
// One thread tilts the shading normal at one pixel of sand by the slope of the trails (footprints and drag
// marks) there. Where a trail shades itself, the normal turns away from the sun.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/surface_images.glsl"
#include "shaders/unit.glsl"
#include "techniques/terrain/plane_step.glsl"
#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D trail_image;
layout(binding = 4, rg32ui) uniform uimage2D normal_image;

layout(push_constant, scalar) uniform Constants
{
    TrailRelief relief;
};

const int shadow_steps = 8;
const float longest_m = 0.5; // largest size of a pixel on the ground; trails are invisible in larger pixels

float trail_height_m(vec2 place_m)
{
    vec2 size_m = relief.texel_m * vec2(textureSize(trail_image, 0));
    return textureLod(trail_image, (place_m - relief.corner_m) / size_m, 0.0).x;
}

// Slope of the trails along a step on the ground, measured over at least one texel.
float rise(vec2 place_m, vec2 along_m, float length_m)
{
    vec2 aside = 0.5 * max(length_m, relief.texel_m) / length_m * along_m;
    return (trail_height_m(place_m + aside) - trail_height_m(place_m - aside)) /
           max(length_m, relief.texel_m);
}

// Share of the sunlight that reaches a place and is not blocked by the sand around it. The heights are
// sampled texel by texel towards the sun.
float sun_left(vec2 place_m, vec3 normal)
{
    float up = dot(relief.towards_sun, normal);
    vec2 level = relief.towards_sun.xz - up * normal.xz;
    float level_m = length(level);
    if (up <= 0.0 || level_m < 1e-3) {
        return 1.0;
    }
    float here = trail_height_m(place_m);
    float rising = up / level_m;
    float highest = 0.0; // largest height above the ray to the sun, divided by the distance
    for (int i = 1; i <= shadow_steps; ++i) {
        float way = float(i) * relief.texel_m;
        highest = max(highest, (trail_height_m(place_m + way / level_m * level) - here) / way - rising);
    }
    return 1.0 - smoothstep(0.0, 0.25 * rising, highest);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uint word = texelFetch(draw_image, pixel, 0).x;
    if (!sees_draw(word) || draw_of(word) != relief.draw) {
        return;
    }
    vec2 position_px = vec2(pixel) + 0.5;
    float depth = max(texelFetch(depth_image, pixel, 0).x, 1e-9);
    vec3 place = anchor_at(frame, position_px, depth);
    vec2 size_m = relief.texel_m * vec2(textureSize(trail_image, 0));
    vec2 within = (place.xz - relief.corner_m) / size_m;
    if (any(lessThan(within, vec2(0.0))) || any(greaterThan(within, vec2(1.0)))) {
        return;
    }
    uvec2 packed = imageLoad(normal_image, pixel).xy;
    vec3 smooth_normal = unpack_normal(packed.y);
    vec2 right = step_on_plane(frame, position_px, depth, place, smooth_normal, vec2(1.0, 0.0)).xz;
    vec2 down = step_on_plane(frame, position_px, depth, place, smooth_normal, vec2(0.0, 1.0)).xz;
    float right_m = max(length(right), 1e-6);
    float down_m = max(length(down), 1e-6);
    float turned = (right.x * down.y - right.y * down.x) / (right_m * down_m);
    if (max(right_m, down_m) > longest_m || abs(turned) < 1e-3 || smooth_normal.y <= 0.0) {
        return;
    }
    // The slope in x and z is solved from the slopes measured along two steps on the ground.
    float along_right = rise(place.xz, right, right_m);
    float along_down = rise(place.xz, down, down_m);
    vec2 slope =
        (along_right * vec2(down.y, -down.x) / down_m + along_down * vec2(-right.y, right.x) / right_m) /
        turned;
    float shade = 1.0 - sun_left(place.xz, smooth_normal);
    if (slope == vec2(0.0) && shade <= 0.0) {
        return;
    }
    vec3 normal = unpack_normal(packed.x);
    normal = unit(normal - normal.y * vec3(slope.x, 0.0, slope.y));
    normal = unit(normal - shade * max(dot(normal, relief.towards_sun), 0.0) * relief.towards_sun);
    imageStore(normal_image, pixel, uvec4(pack_normal(normal), packed.y, 0u, 0u));
}
