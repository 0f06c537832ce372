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

#define LOOKS_BINDING 4
#define HAS_LOOKS ((variant & subsurface_has_looks) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/looks.glsl"

layout(binding = 6, rgba16f) uniform image2D light;

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

#include "techniques/subsurface/scatter.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uint word = texelFetch(draw_image, min(pixel, ivec2(frame.size_px) - 1), 0).x;
    vec3 scatter_m = takes_light_in(word) ? look_scatter(look_of(word)).rgb : vec3(0.0);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, max(texelFetch(depth_image, pixel, 0).x, 1e-9));
    float pixel_m = pixel_size_m(frame, point);
    vec3 spread_px = min(scatter_m / pixel_m, vec3(constants.most_px));
    vec3 kept = share_up_to(kept_below_px(), spread_px);
    bool scatters = kept != vec3(1.0);
    float tolerance_m = max(4.0 * pixel_m, max(max(scatter_m.x, scatter_m.y), scatter_m.z));
    float per_variance = -0.5 / max(tolerance_m * tolerance_m, 1e-12);
    float ahead = ahead_m(point);
    // Pixels of the half page stand for the middle of four of the page.
    vec2 place = 0.5 * (vec2(pixel) + vec2(frame.tile_from_px)) - 0.25 - vec2(constants.from_half);
    ivec2 first = ivec2(floor(place));
    vec2 between = place - vec2(first);
    vec4 sum = vec4(0.0);
    int i = 0;
    int corners = scatters ? 4 : 1;
    do {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 looked = first + corner;
        ivec2 held = clamp(looked, ivec2(0), ivec2(constants.half_px) - 1);
        vec4 other = texelFetch(sum_image, held, 0);
        vec2 bilinear = mix(1.0 - between, between, vec2(corner));
        float off = other.w - ahead;
        float near = is_on_half_page(looked) ? exp(max(per_variance * off * off, -40.0)) : 0.0;
        sum += bilinear.x * bilinear.y * near * vec4(other.rgb, 1.0);
        ++i;
    } while (i < corners);
    if (!scatters || sum.w <= 1e-6) {
        return;
    }
    vec3 own = imageLoad(light, pixel).rgb;
    vec3 mixed = kept * own + sum.rgb / sum.w;
    imageStore(light, pixel, vec4(mixed, luminance(mixed)));
}
