// SPDX-License-Identifier: MIT
// One workgroup spreads light in a tile of pixels that are as far apart as the blur's taps (pixels read). The
// workgroup blurs along rows and then along columns, each by five taps with the weights of a B-spline. Pixels
// too far apart along the view exchange no light; light that would cross the gap stays in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D spread_image;
layout(binding = 2) uniform sampler2D light_image;
layout(binding = 3, rgba32f) writeonly uniform image2D out_light;
layout(binding = 4, rgba32f) uniform image2D sum_image; // sum of the blurred images; each blur pass adds one

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#include "techniques/subsurface/scatter.glsl"

const int side = int(blur_tile_side);
const int beside = 2; // taps (pixels read) of the blur to each side
const int wide = side + 2 * beside;
const int in_rows = wide * wide; // index in `held` of the light that has been blurred along rows

shared vec4 held[wide * wide + side * wide]; // light in rgb, distance along the view in alpha

// Change of a pixel's light, stored at index `at`, by its neighbours. The neighbours are `stride` apart in
// shared memory, and `along` apart on the half page (every second pixel).
vec3 change_along(int at, int stride, ivec2 half_pixel, ivec2 along)
{
    vec4 own = held[at];
    float by = falloff_at(own, 1 << constants.level);
    vec3 change = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        int tap = i < 2 ? i - 2 : i - 1;
        bool is_there = is_on_half_page(half_pixel + tap * along);
        change += is_there ? change_by(own, held[at + tap * stride], abs(tap), by) : vec3(0.0);
    }
    return change;
}

void main()
{
    int apart = 1 << constants.level;
    ivec2 group = ivec2(gl_WorkGroupID.xy);
    ivec2 first = (group >> constants.level) * side * apart + (group & (apart - 1));
    ivec2 last_of_page = ivec2(constants.half_px) - 1;
    int thread = int(gl_LocalInvocationIndex);
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 half_pixel = first + apart * local;
    // The texel reads below start early, because their results are needed last.
    vec3 spread_px = texelFetch(spread_image, min(half_pixel, last_of_page), 0).rgb;
    vec4 sum = imageLoad(sum_image, min(half_pixel, last_of_page));
    for (int i = thread; i < wide * wide; i += side * side) {
        ivec2 pixel = first + apart * (ivec2(i % wide, i / wide) - beside);
        held[i] = texelFetch(light_image, clamp(pixel, ivec2(0), last_of_page), 0);
    }
    barrier();
    for (int i = thread; i < side * wide; i += side * side) {
        ivec2 place = ivec2(i % side, i / side);
        int at = place.y * wide + place.x + beside;
        ivec2 pixel = first + apart * (place - ivec2(0, beside));
        vec3 change = change_along(at, 1, pixel, ivec2(apart, 0));
        held[in_rows + i] = vec4(held[at].rgb + change, held[at].w);
    }
    barrier();
    if (!is_on_half_page(half_pixel)) {
        return;
    }
    int at = in_rows + (local.y + beside) * side + local.x;
    vec3 change = change_along(at, side, half_pixel, ivec2(0, apart));
    vec4 own = vec4(held[at].rgb + change, held[at].w);
    imageStore(out_light, half_pixel, own);
    vec3 share = share_of_level(constants.level, spread_px);
    imageStore(sum_image, half_pixel, vec4(sum.rgb + share * own.rgb, sum.w));
}
