// SPDX-License-Identifier: MIT
// One thread blurs one pixel by reading mip levels of the page: either the one mip level with texels as large
// as the pixel's blur circle, or the sum of all mip levels up to that level. The sum of mip levels gives a
// rounder blur.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1) uniform usampler2D level_image;
layout(binding = 2, rgba32ui) writeonly uniform uimage2D out_texel;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_sum = (variant & lens_is_sum) != 0u;

#include "techniques/lens/lens_texel.glsl"

// Bilinear lookup in a mip level, weighted by the part of each texel that is covered.
LayerSample level_at(int level, ivec2 pixel)
{
    vec2 place = (vec2(pixel + ivec2(constants.pad_px)) + 0.5) / float(1 << level) - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 part = place - vec2(corner);
    LayerSample sum = no_sample;
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 aside = ivec2(i & 1, i >> 1);
        ivec2 at = clamp(corner + aside, ivec2(0), level_size(level) - 1);
        LensTexel texel = unpack_texel(texelFetch(level_image, level_origin(level) + at, 0));
        vec2 side = mix(1.0 - part, part, vec2(aside));
        float weight = side.x * side.y * texel.part;
        sum = sum_of(sum, scaled(texel.layers, weight));
        weights += weight;
    }
    return scaled(sum, 1.0 / max(weights, 1e-6));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    LensTexel own = unpack_texel(texelFetch(page_image, pixel, 0));
    // A bilinear lookup blurs like a disc whose radius is about four fifths of the texel's side.
    float wanted = log2(max(abs(own.radius_px) / (is_sum ? 0.6 : 0.8), 1.0));
    wanted = min(wanted, float(lens_levels));
    LayerSample sum = no_sample;
    float weights = 0.0;
    for (int level = 0; level < loop_rounds(int(lens_levels) + 1, pixel.x); ++level) {
        float near = clamp(1.0 - abs(wanted - float(level)), 0.0, 1.0);
        float weight = is_sum ? clamp(wanted - float(level) + 1.0, 0.0, 1.0) * float(1 << level) : near;
        LayerSample there = level == 0 ? own.layers : level_at(max(level, 1), pixel);
        sum = sum_of(sum, scaled(there, weight));
        weights += weight;
    }
    imageStore(out_texel, pixel,
               pack_texel(LensTexel(scaled(sum, 1.0 / max(weights, 1e-6)), own.radius_px, 1.0)));
}
