// SPDX-License-Identifier: MIT
// One thread per pixel: lets wet paint stray beside its place, and gathers it at the inner side of its edges,
// where a drying wash leaves most of its pigment.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/noise.glsl"
#include "techniques/pigment/pigment.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D cell_image; // density that was spread
layout(binding = 2, rgba16f) writeonly uniform image2D out_wash;

layout(push_constant, scalar) uniform Constants
{
    PigmentWetConstants constants;
};

// Length over which the direction changes in which paint strays, and size of wet places of the paper.
const float stray_over_mm = 8.0;
const float wet_over_mm = 14.0;

// How far paint strays at a place of the page, at most stray_mm along each axis.
vec2 stray_mm_at(vec2 page_mm)
{
    vec2 wide = vec2(value_noise(page_mm / stray_over_mm, constants.seed),
                     value_noise(page_mm / stray_over_mm, constants.seed + 1u));
    vec2 fine = vec2(value_noise(5.0 * page_mm / stray_over_mm, constants.seed + 2u),
                     value_noise(5.0 * page_mm / stray_over_mm, constants.seed + 3u));
    return constants.stray_mm * (1.75 * wide + 0.25 * fine - 1.0);
}

// How wet the paper is at a place of the page, 0 to 1. About a third of the paper is wet.
float wetness_at(vec2 page_mm)
{
    return smoothstep(0.5, 0.7, value_noise(page_mm / wet_over_mm, constants.seed + 4u));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    vec2 page_px = vec2(uvec2(pixel) + constants.from_px) + 0.5;
    vec2 page_mm = page_px / constants.pixels_per_mm;
    vec2 stray_px = round(constants.pixels_per_mm * stray_mm_at(page_mm));
    ivec2 from = clamp(pixel + ivec2(stray_px), ivec2(0), ivec2(constants.size_px) - 1);
    vec3 through = texelFetch(wash_image, from, 0).rgb;
    if (constants.pool > 0.0 || constants.wet > 0.0) {
        vec3 around = spread_at(cell_image, page_px + stray_px, constants.from_px, constants.cell_px).rgb;
        vec3 density = mix(density_of(through), around, constants.wet * wetness_at(page_mm));
        // Only the darker side of an edge changes: paint does not leave its neighbour.
        through = exp(-(density + constants.pool * max(density - around, vec3(0.0))));
    }
    imageStore(out_wash, pixel, vec4(through, texelFetch(wash_image, pixel, 0).a));
}
