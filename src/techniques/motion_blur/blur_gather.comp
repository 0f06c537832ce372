// SPDX-License-Identifier: MIT
// One thread blurs one pixel of the listed tiles. The thread computes the surfaces that pass over the pixel
// during the exposure, and the surface that is visible when nothing passes. The thread reads all other pixels
// from a packed copy, so that the layers can be modified in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1) uniform sampler2D owner_depth_image;
layout(binding = 2) uniform sampler2D reach_image;
layout(binding = 3, rgba16f) uniform image2D wash_image;
layout(binding = 4, r16f) writeonly uniform image2D out_hatch;
layout(binding = 5, rgba8) writeonly uniform image2D out_lines;

#define TILE_LIST_BINDING 6
#include "shaders/tile_list.glsl"

layout(push_constant, scalar) uniform Constants
{
    MotionBlurConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool shows_velocity = (variant & blur_shows_velocity) != 0u;

#include "shaders/layer_sample.glsl"

const int most_taps = 24;        // largest number of samples if a pixel has one path
const int most_taps_of_two = 16; // largest number of samples along each path if a pixel has two paths

float length_of(vec2 way)
{
    return sqrt(dot(way, way));
}

// Share of the exposure during which a surface covers a pixel at the distance `away_px`. `length_px` is the
// displacement of the surface to either side.
float time_share(float length_px, float away_px)
{
    return clamp(length_px + 0.5 - away_px, 0.0, 1.0) / (2.0 * max(length_px, 0.5));
}

// Returns how certainly the reversed depth `depth` is in front of `other`, from 0 to 1; 0 if `depth` is
// infinitely far.
float is_before(float depth, float other)
{
    return other < depth ? smoothstep(0.02, 0.06, 1.0 - other / depth) : 0.0;
}

struct Passing {
    // Sum of the surfaces in front of the pixel's own surface, weighted by the share of the exposure during
    // which they cover the pixel.
    LayerSample before;
    float before_time;
    LayerSample there; // sum of the pixel's own surface and the surfaces behind it
    float there_time;
};

void pass_along(ivec2 pixel, vec2 way, int most, vec2 own_way, float own_depth, inout Passing passing)
{
    float reach_px = length_of(way);
    float own_px = length_of(own_way);
    int taps = reach_px > 0.0 ? min(int(ceil(2.0 * reach_px + 1.0)), most) : 0;
    vec2 forward = way / max(reach_px, 1e-6);
    float step_px = (2.0 * reach_px + 1.0) / float(max(taps, 1));
    // The do loop runs at least once. Without motion, the only sample has the weight 0.
    int i = 0;
    do {
        float along_px = (float(i) + 0.5) * step_px - reach_px - 0.5;
        vec2 place = vec2(pixel) + along_px * forward;
        ivec2 at = ivec2(floor(place + 0.5));
        bool is_there = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(uvec2(at), constants.size_px));
        at = clamp(at, ivec2(0), ivec2(constants.size_px) - 1);
        uvec4 texel = texelFetch(page_image, at, 0);
        float depth = texelFetch(owner_depth_image, at, 0).x;
        vec2 tap_way = unpackHalf2x16(texel.w);
        float tap_px = length_of(tap_way);
        float away_px = abs(along_px);
        float before = is_before(depth, own_depth);
        float behind = is_before(own_depth, depth);
        float weight = is_there && taps > 0 ? step_px : 0.0;
        // Only a surface that moves in the direction of the sampled path can reach the pixel from the
        // sample's position.
        float same_way = abs(dot(tap_way, forward)) / max(tap_px, 1e-6);
        float moved = tap_px > 0.0 ? same_way * same_way * time_share(tap_px, away_px) * weight : 0.0;
        float uncovered = own_px > 0.0 ? time_share(own_px, away_px) * weight : 0.0;
        LayerSample sample_here = unpack_sample(texel);
        // Of two surfaces at a similar distance, the faster one passes over the slower one.
        float faster = clamp(1.0 - 2.0 * own_px / max(tap_px, 1e-6), 0.0, 1.0);
        before += faster * (1.0 - before - behind);
        passing.before = sum_of(passing.before, scaled(sample_here, before * moved));
        passing.before_time += before * moved;
        float there = (1.0 - before - behind) * moved + behind * uncovered;
        passing.there = sum_of(passing.there, scaled(sample_here, there));
        passing.there_time += there;
        ++i;
    } while (i < taps);
}

void main()
{
    ivec2 pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    vec4 wash = imageLoad(wash_image, pixel);
    uvec4 own = texelFetch(page_image, pixel, 0);
    vec2 own_way = unpackHalf2x16(own.w);
    if (shows_velocity) {
        vec2 part = vec2(own_way.x, -own_way.y) / max(constants.most_px, 1e-6);
        imageStore(wash_image, pixel, vec4(0.5 + 0.5 * part, 0.5, wash.a));
        imageStore(out_hatch, pixel, vec4(0.0));
        imageStore(out_lines, pixel, vec4(0.0));
        return;
    }
    vec2 longest = texelFetch(reach_image, pixel / int(blur_tile_px), 0).xy;
    float own_depth = texelFetch(owner_depth_image, pixel, 0).x;
    bool is_moving = own_way != vec2(0.0);
    Passing passing = Passing(no_sample, 0.0, no_sample, 0.0);
    // The pixel is blurred along two paths. The longest motion in the pixel's tile is the path of surfaces
    // that pass over the pixel. The motion of the pixel's own surface is the second path. One path is enough
    // if both motions are nearly equal.
    bool is_same = length_of(longest - own_way) < 0.05 * length_of(longest);
    int most = is_same || !is_moving ? most_taps : most_taps_of_two;
    pass_along(pixel, longest, most, own_way, own_depth, passing);
    Passing own_passing = Passing(no_sample, 0.0, passing.there, passing.there_time);
    if (!is_same) {
        own_passing.there = no_sample;
        own_passing.there_time = 0.0;
    }
    pass_along(pixel, is_same ? vec2(0.0) : own_way, most, own_way, own_depth, own_passing);
    LayerSample there = unpack_sample(own);
    float there_time = is_moving ? own_passing.there_time : 0.0;
    there = there_time > 1e-4 ? scaled(own_passing.there, 1.0 / max(there_time, 1e-6)) : there;
    float before_time = min(passing.before_time, 1.0);
    LayerSample before = scaled(passing.before, before_time / max(passing.before_time, 1e-6));
    LayerSample sample_here = sum_of(before, scaled(there, 1.0 - before_time));
    bool is_blurred = before_time > 0.0 || there_time > 1e-4;
    if (!is_blurred) {
        return;
    }
    vec3 paint;
    float hatch;
    vec4 lines;
    layers_of_sample(sample_here, wash.rgb, paint, hatch, lines);
    imageStore(wash_image, pixel, vec4(paint, wash.a));
    imageStore(out_hatch, pixel, vec4(hatch));
    imageStore(out_lines, pixel, lines);
}
