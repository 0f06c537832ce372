// SPDX-License-Identifier: MIT
// One thread a pixel of the half page takes the light that spreads from there. Blurs that no pixel needs are
// never run.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D light_image;

#define LOOKS_BINDING 4
#define HAS_LOOKS ((variant & subsurface_has_looks) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/looks.glsl"

layout(binding = 6, rgba32f) writeonly uniform image2D out_light;  // and how far ahead of the eye it is
layout(binding = 7, rgba32f) writeonly uniform image2D out_spread; // by colour, on the page; a pixel there
layout(binding = 8, rgba32f) writeonly uniform image2D out_sum;    // of blurs so far; how far ahead

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

layout(scalar, binding = 9) buffer Needs
{
    uvec4 needs[]; // how many groups to dispatch: over the page, then for one blur after another
};

#include "techniques/subsurface/scatter.glsl"

shared uint needed_by_group;

// How many of the passes that follow a pixel needs, if any: the page first, then one blur after another.
uint passes_for(vec3 spread_px)
{
    float widest = max(max(spread_px.r, spread_px.g), spread_px.b);
    uint passes = holds_all(kept_below_px(), widest) ? 0u : 1u;
    for (int level = 0; level < constants.level; ++level) {
        passes += holds_all(level_from_px(level), widest) ? 0u : 1u;
    }
    return passes;
}

void main()
{
    ivec2 half_pixel = min(ivec2(gl_GlobalInvocationID.xy), ivec2(constants.half_px) - 1);
    if (gl_LocalInvocationIndex == 0u) {
        needed_by_group = 0u;
    }
    barrier();
    ivec2 pixel = whole_pixel(half_pixel);
    uint word = texelFetch(draw_image, pixel, 0).x;
    vec3 scatter_m = takes_light_in(word) ? look_scatter(look_of(word)).rgb : vec3(0.0);
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(texelFetch(depth_image, pixel, 0).x, 1e-9));
    float pixel_m = pixel_size_m(frame, point);
    vec3 spread_px = min(scatter_m / pixel_m, vec3(constants.most_px));
    uint passes = passes_for(spread_px);
    bool scatters = passes > 0u;
    // Light of the pixels about it counts, so that the edge of a shadow does not jump from one to the next.
    vec4 sum = vec4(0.0);
    int i = 0;
    int corners = scatters ? 4 : 1;
    do {
        ivec2 looked = min(pixel + ivec2(i & 1, i >> 1), ivec2(frame.size_px) - 1);
        float share = texelFetch(draw_image, looked, 0).x == word ? 1.0 : 0.0;
        sum += share * vec4(texelFetch(light_image, looked, 0).rgb, 1.0);
        ++i;
    } while (i < corners);
    float ahead = scatters ? ahead_m(point) : nowhere_m;
    vec3 light = sum.rgb / max(sum.w, 1.0);
    vec3 share = share_up_to(level_from_px(0), spread_px) - share_up_to(kept_below_px(), spread_px);
    imageStore(out_light, half_pixel, vec4(light, ahead));
    imageStore(out_spread, half_pixel, vec4(spread_px, pixel_m));
    imageStore(out_sum, half_pixel, vec4(share * light, ahead));
    atomicMax(needed_by_group, passes);
    barrier();
    // One thread for each says that it has to run.
    uint pass = gl_LocalInvocationIndex;
    if (pass < needed_by_group) {
        uvec2 threads = pass == 0u ? frame.size_px : constants.half_px;
        atomicMax(needs[pass].x, (threads.x + 7u) / 8u);
        atomicMax(needs[pass].y, (threads.y + 7u) / 8u);
        atomicMax(needs[pass].z, 1u);
    }
}
