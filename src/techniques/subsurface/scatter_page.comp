// SPDX-License-Identifier: MIT
// One thread a pixel of the page lays what light has come from elsewhere under the surface over what stays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "shaders/frame.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usampler2D draw_image;
layout(binding = 2) uniform sampler2D depth_image;
layout(binding = 3) uniform sampler2D sum_image;
layout(binding = 4) uniform sampler2D source_image;

#define LOOKS_BINDING 5
#define HAS_LOOKS ((variant & subsurface_has_looks) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/looks.glsl"

layout(binding = 7, rgba16f) uniform image2D light;

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#include "techniques/subsurface/scatter.glsl"

const float kept_deviation = 0.0809; // of d
const float least_px = 0.5;          // what spreads less than this on the page is left as it is

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uint word = texelFetch(draw_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    float scatter_m = takes_light_in(word) ? looks[look_of(word)].scatter_m : 0.0;
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px)) || scatter_m <= 0.0) {
        return;
    }
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, texelFetch(depth_image, pixel, 0).x);
    vec2 spread = spread_at(scatter_m, point);
    float per_variance = -0.5 / max(spread.y * spread.y, 1e-12);
    float ahead = ahead_m(point);
    // Pixels of the half page stand for the middle of four of the page.
    vec2 place = 0.5 * (vec2(pixel) + vec2(frame.tile_from_px)) - 0.25 - vec2(constants.from_half);
    ivec2 first = ivec2(floor(place));
    vec2 between = place - vec2(first);
    vec4 sum = vec4(0.0);
    vec3 source = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 looked = first + corner;
        ivec2 held = clamp(looked, ivec2(0), ivec2(constants.half_px) - 1);
        vec4 other = texelFetch(sum_image, held, 0);
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        float off = other.w - ahead;
        float near = is_on_half_page(looked) ? exp(max(per_variance * off * off, -40.0)) : 0.0;
        sum += bilinear.x * bilinear.y * near * vec4(other.rgb, 1.0);
        source += bilinear.x * bilinear.y * near * texelFetch(source_image, held, 0).rgb;
    }
    vec3 own = imageLoad(light, pixel).rgb;
    // What stays is a Gaussian too, of a pixel or less: a share of the next pixels stands for it, as much as
    // gives the pixel beside a step what that has.
    float beside = clamp(2.2 * kept_deviation * spread.x - 0.5, 0.0, 1.0);
    vec3 kept = mix(own, source / max(sum.w, 1e-6), beside);
    vec3 spread_light = constants.kept * kept + sum.rgb / max(sum.w, 1e-6);
    float share = sum.w > 1e-6 ? clamp(spread.x / least_px - 1.0, 0.0, 1.0) : 0.0;
    vec3 mixed = mix(own, spread_light, share);
    imageStore(light, pixel, vec4(mixed, luminance(mixed)));
}
