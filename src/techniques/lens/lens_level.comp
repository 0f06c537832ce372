// SPDX-License-Identifier: MIT
// One thread makes one texel of a mip level from four texels of the next finer level. If the four texels show
// two surfaces, the thread keeps only one surface, and the part of the area that the kept surface covers. The
// thread prefers a surface in front of the focus, otherwise the most blurred surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image; // packed page; only read for the first mip level
layout(binding = 1, rgba32ui) uniform uimage2D level_image;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_of_page = (variant & lens_of_page) != 0u;
const bool is_plain = (variant & lens_plain) != 0u;

#include "techniques/lens/lens_texel.glsl"

LensTexel texel_below(ivec2 at)
{
    if (!is_of_page) {
        return unpack_texel(imageLoad(level_image, level_origin(int(constants.level) - 1) + at));
    }
    ivec2 pixel = at - ivec2(constants.pad_px);
    bool is_drawn = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(uvec2(pixel), constants.size_px));
    LensTexel texel =
        unpack_texel(texelFetch(page_image, clamp(pixel, ivec2(0), ivec2(constants.size_px) - 1), 0));
    texel.part = is_drawn ? 1.0 : 0.0;
    return texel;
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    int level = int(constants.level);
    if (any(greaterThanEqual(at, level_size(level)))) {
        return;
    }
    LensTexel below[4];
    float nearest = 1e9;
    float farthest = -1e9;
    for (int i = 0; i < 4; ++i) {
        below[i] = texel_below(2 * at + ivec2(i & 1, i >> 1));
        bool is_there = below[i].part > 0.0;
        nearest = is_there ? min(nearest, below[i].radius_px) : nearest;
        farthest = is_there ? max(farthest, below[i].radius_px) : farthest;
    }
    float kept = nearest < -lens_sharp_px ? nearest : farthest;
    float tolerance = max(0.5, 0.25 * abs(kept));
    LensTexel texel = LensTexel(no_sample, 0.0, 0.0);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        float alike = is_plain ? 1.0 : clamp(2.0 - abs(below[i].radius_px - kept) / tolerance, 0.0, 1.0);
        float weight = alike * below[i].part;
        texel.layers = sum_of(texel.layers, scaled(below[i].layers, weight));
        texel.radius_px += weight * below[i].radius_px;
        sum += weight;
    }
    texel.layers = scaled(texel.layers, 1.0 / max(sum, 1e-6));
    texel.radius_px /= max(sum, 1e-6);
    texel.part = 0.25 * sum;
    imageStore(level_image, level_origin(level) + at, pack_texel(texel));
}
