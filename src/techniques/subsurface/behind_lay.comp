// SPDX-License-Identifier: MIT
// One thread per pixel blends the background seen through a body with the body's own paint. The background is
// blurred by a cubic spline over one of its halved images, which is chosen to match the blur's width. With
// HAS_REFRACTION, the background is read at the place where the bent view ray meets it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D clear_image;
layout(binding = 1) uniform sampler2D share_image;
layout(binding = 2) uniform sampler2D level_0;
layout(binding = 3) uniform sampler2D level_1;
layout(binding = 4) uniform sampler2D level_2;
layout(binding = 5) uniform sampler2D level_3;
layout(binding = 6) uniform sampler2D level_4;
layout(binding = 7) uniform sampler2D level_5;
#ifdef HAS_REFRACTION
layout(binding = 8) uniform sampler2D seen_image; // see refract.comp
layout(binding = 9, rgba16f) uniform image2D wash;
#else
layout(binding = 8, rgba16f) uniform image2D wash;
#endif

layout(push_constant) uniform Constants
{
    float most_px; // largest standard deviation of the background's blur
}

constants;

vec3 level_at(int level, vec2 place)
{
    return level == 0   ? textureLod(level_0, place, 0.0).rgb
           : level == 1 ? textureLod(level_1, place, 0.0).rgb
           : level == 2 ? textureLod(level_2, place, 0.0).rgb
           : level == 3 ? textureLod(level_3, place, 0.0).rgb
           : level == 4 ? textureLod(level_4, place, 0.0).rgb
                        : textureLod(level_5, place, 0.0).rgb;
}

// The background at one of its halved sizes, smoothed by a cubic B-spline over sixteen texels. Four bilinear
// lookups read the sixteen texels; after Sigg and Hadwiger, "Fast Third-Order Texture Filtering", GPU Gems 2,
// 2005.
vec3 smooth_at(int level, vec2 pixel, vec2 size_px)
{
    vec2 texels = ceil(size_px / float(1 << level));
    vec2 place = pixel / float(1 << level) - 0.5;
    vec2 first = floor(place);
    vec2 t = place - first;
    vec2 w0 = (1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0;
    vec2 w1 = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
    vec2 w3 = t * t * t / 6.0;
    vec2 w2 = 1.0 - w0 - w1 - w3;
    vec2 low = w0 + w1;
    vec2 from = (first - 0.5 + w1 / low) / texels;
    vec2 to = (first + 1.5 + w3 / (w2 + w3)) / texels;
    vec3 sum = vec3(0.0);
    int i = 0;
    do {
        bvec2 far = bvec2((i & 1) != 0, (i >> 1) != 0);
        vec2 weight = mix(low, 1.0 - low, far);
        sum += weight.x * weight.y * level_at(level, mix(from, to, far));
        ++i;
    } while (i < 4);
    return sum;
}

// Standard deviation, in pixels of the page, of the blur of one halved background image. The blur comes from
// repeated halving and from the spline.
float deviation_of(int level)
{
    float side = float(1 << level);
    return sqrt((side * side - 1.0) / 12.0 + side * side / 3.0);
}

#ifdef HAS_REFRACTION
// Change of the seen place per pixel along `way`: the smaller of the changes to both sides, so that edges of
// bodies do not count.
vec2 change_along(ivec2 pixel, ivec2 way, ivec2 size_px)
{
    vec2 here = texelFetch(seen_image, pixel, 0).xy;
    vec4 next = texelFetch(seen_image, min(pixel + way, size_px - 1), 0);
    vec4 last = texelFetch(seen_image, max(pixel - way, ivec2(0)), 0);
    vec2 ahead = next.w > 0.0 ? next.xy - here : vec2(way);
    vec2 back = last.w > 0.0 ? here - last.xy : vec2(way);
    vec2 change = dot(ahead, ahead) < dot(back, back) ? ahead : back;
    return change * min(1.0, bent_footprint_px * inversesqrt(max(dot(change, change), 1e-12)));
}

// The background in the parallelogram that a pixel shows around `place`: sixteen samples where the body
// shrinks the background, else one.
vec3 background_in(ivec2 pixel, vec2 place, ivec2 size_px)
{
    vec2 across = change_along(pixel, ivec2(1, 0), size_px);
    vec2 down = change_along(pixel, ivec2(0, 1), size_px);
    bool is_wide = max(dot(across, across), dot(down, down)) > 1.5;
    vec3 sum = vec3(0.0);
    int i = 0;
    int count = is_wide ? 16 : 1;
    do {
        vec2 beside = is_wide ? (vec2(i & 3, i >> 2) - 1.5) / 4.0 : vec2(0.0);
        sum += level_at(0, (place + beside.x * across + beside.y * down) / vec2(size_px));
        ++i;
    } while (i < count);
    return sum / float(count);
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size_px = imageSize(wash);
    if (any(greaterThanEqual(pixel, size_px))) {
        return;
    }
    float share = texelFetch(share_image, pixel, 0).x;
    if (share <= 0.0) {
        return;
    }
    vec4 clear = texelFetch(clear_image, pixel, 0);
    float wanted_px = min(clear.a, constants.most_px);
#ifdef HAS_REFRACTION
    vec4 seen = texelFetch(seen_image, pixel, 0);
    vec2 middle_px = seen.xy;
#else
    vec2 middle_px = vec2(pixel) + 0.5;
#endif
    // Two halved images of the background are interpolated by the variance of their blur. The unblurred
    // background counts as the finest image.
    int upper = 0;
    while (upper < int(behind_levels) - 1 && deviation_of(upper) < wanted_px) {
        ++upper;
    }
    float below = upper == 0 ? 0.0 : deviation_of(upper - 1);
    float above = deviation_of(upper);
    float part = clamp((wanted_px * wanted_px - below * below) / (above * above - below * below), 0.0, 1.0);
    vec3 finer;
    if (upper > 0) {
        finer = smooth_at(upper - 1, middle_px, vec2(size_px));
    } else {
        finer = texelFetch(level_0, pixel, 0).rgb;
#ifdef HAS_REFRACTION
        finer = seen.w > 0.0 ? background_in(pixel, middle_px, size_px) : finer;
#endif
    }
    vec3 behind = mix(finer, smooth_at(upper, middle_px, vec2(size_px)), part);
    vec4 own = imageLoad(wash, pixel);
    imageStore(wash, pixel, vec4(mix(own.rgb, clear.rgb * behind, share), own.a));
}
