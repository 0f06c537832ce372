// SPDX-License-Identifier: MIT
// One thread per texel of the map collects the light that spreads from it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/subsurface/subsurface.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D draw_image;
layout(binding = 1) uniform sampler2D point_image;
layout(binding = 2) uniform sampler2D light_image;

#define PARAMETERS_BINDING 3
#define HAS_VARIANTS ((variant & subsurface_has_variants) != 0u)
layout(constant_id = 0) const uint variant = 0u;
#include "techniques/subsurface/parameters.glsl"

// Light that falls on the texel; alpha is 1 where it spreads.
layout(binding = 5, rgba32f) writeonly uniform image2D out_light;
// Scattering distance per colour, in texels; the size of a texel in alpha.
layout(binding = 6, rgba32f) writeonly uniform image2D out_spread;
// Sum of the blur levels so far; alpha is 1 where light spreads.
layout(binding = 7, rgba32f) writeonly uniform image2D out_sum;

layout(push_constant, scalar) uniform Constants
{
    TextureConstants constants;
};

#include "techniques/subsurface/profile.glsl"

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(texel), uvec2(constants.size)))) {
        return;
    }
    uint word = texelFetch(draw_image, texel, 0).x;
    vec3 scatter_m = takes_light_in(word) ? scatter_of(style_variant_of(word)).rgb : vec3(0.0);
    float is_there = scatter_m != vec3(0.0) ? 1.0 : 0.0;
    float texel_m = texelFetch(point_image, texel, 0).w;
    vec3 spread = min(scatter_m / max(texel_m, 1e-12), vec3(constants.most_tx));
    vec3 light = texelFetch(light_image, texel, 0).rgb;
    vec3 share = share_below(level_from_tx(0), spread) - share_below(kept_below_tx(), spread);
    imageStore(out_light, texel, vec4(light, is_there));
    imageStore(out_spread, texel, vec4(spread, texel_m));
    imageStore(out_sum, texel, vec4(share * light, is_there));
}
