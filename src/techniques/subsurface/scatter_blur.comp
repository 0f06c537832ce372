// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) spreads light along rows or columns, by five
// taps (pixels read) with the weights of a B-spline. Pixels too far apart along the view exchange no light;
// light that would cross the gap stays in place. The shader scatter_blur.comp is for CPUs, whose threads
// share memory slowly. On GPUs, scatter_blur_tile.comp blurs rows and columns in one dispatch.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

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

layout(constant_id = 0) const uint variant = 0u;
const bool is_upright = (variant & subsurface_is_upright) != 0u;

#include "techniques/subsurface/scatter.glsl"

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    vec4 own = texelFetch(light_image, half_pixel, 0);
    int apart = 1 << constants.level;
    float by = falloff_at(own, apart);
    // The blur's direction is computed at run time, because Mesa replaces a vector that a specialization
    // constant selects with the constant's default.
    int upright = is_upright ? 1 : 0;
    ivec2 along = apart * ivec2(1 - upright, upright);
    int taps = by < 0.0 ? 4 : 1;
    vec3 change = vec3(0.0);
    int i = 0;
    do {
        int tap = i < 2 ? i - 2 : i - 1;
        ivec2 pixel = half_pixel + tap * along;
        vec4 other = texelFetch(light_image, clamp(pixel, ivec2(0), ivec2(constants.half_px) - 1), 0);
        change += is_on_half_page(pixel) ? change_by(own, other, abs(tap), by) : vec3(0.0);
        ++i;
    } while (i < taps);
    own.rgb += change;
    imageStore(out_light, half_pixel, own);
    if (is_upright) {
        vec3 share = share_of_level(constants.level, texelFetch(spread_image, half_pixel, 0).rgb);
        vec4 sum = imageLoad(sum_image, half_pixel);
        imageStore(sum_image, half_pixel, vec4(sum.rgb + share * own.rgb, sum.w));
    }
}
