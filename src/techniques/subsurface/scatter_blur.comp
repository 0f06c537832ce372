// SPDX-License-Identifier: MIT
// One thread a pixel of the half page lets light spread along rows, or along columns, by a Gaussian of the
// distance in the scene. What lies too far off along the view gives nothing, and gets nothing: its share
// stays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D spread_image;
layout(binding = 2) uniform sampler2D light_image;
layout(binding = 3) uniform sampler2D sum_image; // of the levels before

#define LOOKS_BINDING 4
#define HAS_LOOKS false
#include "techniques/subsurface/looks.glsl"

layout(binding = 6, rgba32f) writeonly uniform image2D out_light;
layout(binding = 7, rgba32f) writeonly uniform image2D out_sum;

layout(push_constant, scalar) uniform Constants
{
    ScatterConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_upright = (variant & subsurface_is_upright) != 0u;
const bool is_first = (variant & subsurface_is_first) != 0u;

#include "techniques/subsurface/scatter.glsl"

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    vec4 own = texelFetch(light_image, half_pixel, 0);
    vec3 spread = texelFetch(spread_image, half_pixel, 0).xyz;
    if (spread.x > 0.0) {
        uint look = uint(spread.z);
        // Of the first blur a part has been done by taking every second pixel.
        float variance = constants.level.blur * constants.level.blur;
        variance -= is_first ? half_page_variance_px2 / (spread.x * spread.x) : 0.0;
        float blur = sqrt(max(variance, 0.0));
        float spacing_px = scatter_spacing * 0.5 * blur * spread.x; // on the half page
        float per_variance = -0.5 / max(blur * blur * spread.y * spread.y, 1e-12);
        // Mesa takes a vector that a specialization constant chooses for the one it has by default.
        float upright = is_upright ? 1.0 : 0.0;
        vec2 along = vec2(1.0 - upright, upright);
        vec3 change = vec3(0.0);
        for (int i = 0; i < 2 * int(scatter_taps); ++i) {
            int tap = (i >> 1) + 1;
            float away = ((i & 1) == 0 ? 1.0 : -1.0) * (float(tap) + 0.25 * float(tap * tap)) * spacing_px;
            vec2 place = vec2(half_pixel) + 0.5 + away * along;
            ivec2 looked = ivec2(floor(place - 0.5 * along));
            float between = fract(away);
            vec3 weight = looks[look].weights[tap].rgb;
            for (int k = 0; k < 2; ++k) {
                ivec2 pixel = looked + (k == 0 ? ivec2(0) : ivec2(along));
                vec4 other = texelFetch(light_image, clamp(pixel, ivec2(0), ivec2(constants.half_px) - 1), 0);
                float off = other.w - own.w;
                float near = is_on_half_page(pixel) ? exp(max(per_variance * off * off, -80.0)) : 0.0;
                change += (k == 0 ? 1.0 - between : between) * near * weight * (other.rgb - own.rgb);
            }
        }
        own.rgb += change;
    }
    imageStore(out_light, half_pixel, own);
    if (is_upright) {
        vec4 sum = vec4(constants.level.share * own.rgb, 0.0);
        if (!is_first) {
            sum += texelFetch(sum_image, half_pixel, 0);
        }
        imageStore(out_sum, half_pixel, vec4(sum.rgb, own.w));
    }
}
