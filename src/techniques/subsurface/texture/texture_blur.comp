// SPDX-License-Identifier: MIT
// One thread per texel of the map spreads light along rows or columns, by five taps (texels read) with the
// weights of a B-spline. Texels across a seam are farther apart in the scene than in the map, and exchange no
// light. Light that would cross the seam stays in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D spread_image;
layout(binding = 1) uniform sampler2D point_image;
layout(binding = 2) uniform sampler2D light_image;
layout(binding = 3) uniform sampler2D sum_image; // sum of the previous blur levels

layout(binding = 4, rgba32f) writeonly uniform image2D out_light;
layout(binding = 5, rgba32f) writeonly uniform image2D out_sum;

layout(push_constant, scalar) uniform Constants
{
    TextureConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_upright = (variant & subsurface_is_upright) != 0u;

#include "techniques/subsurface/profile.glsl"

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(texel), uvec2(constants.size)))) {
        return;
    }
    vec4 own = texelFetch(light_image, texel, 0);
    vec4 point = texelFetch(point_image, texel, 0);
    int apart = 1 << constants.level;
    // The blur's direction is computed at run time, because Mesa replaces a vector that a specialization
    // constant selects with the constant's default.
    int upright = is_upright ? 1 : 0;
    ivec2 along = apart * ivec2(1 - upright, upright);
    int taps = own.w > 0.0 ? 4 : 1;
    vec3 change = vec3(0.0);
    int i = 0;
    do {
        int tap = i < 2 ? i - 2 : i - 1;
        ivec2 looked = texel + tap * along;
        ivec2 held = clamp(looked, ivec2(0), ivec2(constants.size) - 1);
        vec4 other = texelFetch(light_image, held, 0);
        vec4 there = texelFetch(point_image, held, 0);
        float expected_m = 0.5 * float(abs(tap) * apart) * (point.w + there.w);
        float beyond = max(distance(there.xyz, point.xyz) / max(expected_m, 1e-12) - 1.0, 0.0);
        float near = held == looked ? own.w * other.w * exp(max(-0.5 * beyond * beyond, -80.0)) : 0.0;
        change += (abs(tap) == 2 ? 0.0625 : 0.25) * near * (other.rgb - own.rgb);
        ++i;
    } while (i < taps);
    own.rgb += change;
    imageStore(out_light, texel, own);
    if (is_upright) {
        vec3 spread = texelFetch(spread_image, texel, 0).rgb;
        vec3 until =
            constants.is_last != 0u ? vec3(1.0) : share_below(level_from_tx(constants.level + 1), spread);
        vec3 share = until - share_below(level_from_tx(constants.level), spread);
        imageStore(out_sum, texel, vec4(texelFetch(sum_image, texel, 0).rgb + share * own.rgb, own.w));
    }
}
