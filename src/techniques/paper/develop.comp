// SPDX-License-Identifier: MIT
// One thread adds one pixel of this frame to the mean of the frames before; the last frame writes it out as
// sRGB bytes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "techniques/paper/paper.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D picture_image;

layout(std430, binding = 1) buffer Sums
{
    vec4 sums[];
};

layout(std430, binding = 2) writeonly buffer Pixels
{
    uint pixels[];
};

layout(push_constant, scalar) uniform Constants
{
    DevelopConstants constants;
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= constants.width || pixel.y >= constants.height) {
        return;
    }
    uint index = pixel.y * constants.width + pixel.x;
    vec3 color = texelFetch(picture_image, ivec2(pixel), 0).rgb;
    if (constants.sample_count > 1u) {
        vec4 sum = constants.sample_index == 0u ? vec4(0.0) : sums[index];
        sum.rgb += color;
        sums[index] = sum;
        color = sum.rgb / float(constants.sample_index + 1u);
    }
    if (constants.sample_index + 1u == constants.sample_count) {
        pixels[index] = packUnorm4x8(vec4(srgb_from_linear(clamp(color, 0.0, 1.0)), 1.0));
    }
}
