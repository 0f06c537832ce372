// SPDX-License-Identifier: MIT
// One thread smooths the darkness of one pixel before it is grouped into tones: the mean of the pixels around
// whose darkness differs by less than half the distance of two tones. Fine texture becomes even, and edges
// between light and shade stay where they are. Lee, "Digital Image Smoothing and the Sigma Filter", Computer
// Vision, Graphics and Image Processing 1983.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/hatch/hatch.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D darkness_image;
layout(binding = 1, r16f) writeonly uniform image2D out_smooth;

layout(push_constant, scalar) uniform Constants
{
    GroupConstants constants;
};

// Places to each side at which the darkness is read, along each axis.
const int places = 3;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    float dark = texelFetch(darkness_image, pixel, 0).x;
    float most_difference = 0.5 / float(constants.count - 1u);
    float sum = 0.0;
    float count = 0.0;
    for (int i = 0; i < (2 * places + 1) * (2 * places + 1); ++i) {
        vec2 place = vec2(i % (2 * places + 1), i / (2 * places + 1)) - float(places);
        ivec2 at = pixel + ivec2(round(place * constants.smooth_px / float(places)));
        float beside = texelFetch(darkness_image, clamp(at, ivec2(0), ivec2(constants.size_px) - 1), 0).x;
        bool is_alike = beside >= 0.0 && abs(beside - dark) < most_difference;
        bool is_near = dot(place, place) <= float(places * places) + 1.0;
        sum += is_alike && is_near ? beside : 0.0;
        count += is_alike && is_near ? 1.0 : 0.0;
    }
    imageStore(out_smooth, pixel, vec4(dark < 0.0 ? dark : sum / count));
}
