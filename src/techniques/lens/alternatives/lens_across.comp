// SPDX-License-Identifier: MIT
// One thread blurs one pixel horizontally or vertically by the pixel's own blur circle. Surfaces farther away
// than the pixel are left out, so that far surfaces do not blur over nearer surfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D page_image;
layout(binding = 1, rgba32ui) writeonly uniform uimage2D out_texel;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_down = (variant & lens_is_down) != 0u;

#include "techniques/lens/lens_texel.glsl"

const int taps_aside = 6;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    LensTexel own = unpack_texel(texelFetch(page_image, pixel, 0));
    // The weights are a Gaussian curve with the standard deviation of the blur circle. The Gaussian curve is
    // cut off where it falls to an eighth of the peak.
    float spread_px = 0.5 * abs(own.radius_px);
    float step_px = 2.0 * spread_px / float(taps_aside);
    LayerSample sum = no_sample;
    float weights = 0.0;
    for (int i = -taps_aside; i <= taps_aside; ++i) {
        int away = int(floor(float(i) * step_px + 0.5));
        ivec2 at = clamp(pixel + (is_down ? ivec2(0, away) : ivec2(away, 0)), ivec2(0),
                         ivec2(constants.size_px) - 1);
        LensTexel tap = unpack_texel(texelFetch(page_image, at, 0));
        float part = 2.0 * float(i) / float(taps_aside);
        float tolerance = max(1.0, 0.25 * abs(own.radius_px));
        float weight = exp(-0.5 * part * part) * (tap.radius_px > own.radius_px + tolerance ? 0.0 : 1.0);
        sum = sum_of(sum, scaled(tap.layers, weight));
        weights += weight;
    }
    imageStore(out_texel, pixel, pack_texel(LensTexel(scaled(sum, 1.0 / weights), own.radius_px, 1.0)));
}
