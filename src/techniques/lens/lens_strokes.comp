// SPDX-License-Identifier: MIT
// One thread enlarges the stroke footprint of one pixel. Then strokes are as wide and as far apart as if the
// surface were seen from farther away.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D depth_image;
layout(binding = 1) uniform usampler2D footprint_image;
layout(binding = 2, rgba32ui) writeonly uniform uimage2D out_footprint;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float depth = texelFetch(depth_image, pixel, 0).x;
    float radius = abs(constants.radius_px - constants.radius_per_depth * depth);
    float wider = 1.0 + constants.widening_per_px * max(min(radius, constants.most_px) - lens_sharp_px, 0.0);
    uvec4 footprint = texelFetch(footprint_image, pixel, 0);
    // The last word of a footprint is the footprint's scale, see shaders/surface_images.glsl.
    footprint.w = floatBitsToUint(uintBitsToFloat(footprint.w) * wider);
    imageStore(out_footprint, pixel, footprint);
}
