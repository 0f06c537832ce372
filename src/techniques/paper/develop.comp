// SPDX-License-Identifier: MIT
// One thread per pixel adds a frame to the running mean of a picture's samples; the last frame writes the
// mean as sRGB bytes or as floats.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/color.glsl"
#include "techniques/paper/paper.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D picture_image;

layout(binding = 1, rgba32f) uniform image2D sum_image;

layout(std430, binding = 2) writeonly buffer Pixels
{
    uint pixels[]; // one word per pixel; four words for develop_keeps_floats
};

layout(push_constant, scalar) uniform Constants
{
    DevelopConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_samples = (variant & develop_has_samples) != 0u;
const bool is_last = (variant & develop_is_last) != 0u;
const bool keeps_floats = (variant & develop_keeps_floats) != 0u;
const bool is_transparent = (variant & develop_is_transparent) != 0u;

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= constants.width || pixel.y >= constants.height) {
        return;
    }
    ivec2 at = ivec2(pixel);
    vec4 color = texelFetch(picture_image, at, 0);
    // Colours are rounded to half floats like those of opaque pictures, so that the bytes are equal.
    if (is_transparent && !keeps_floats) {
        color.rgb = vec3(unpackHalf2x16(packHalf2x16(color.rg)), unpackHalf2x16(packHalf2x16(color.bb)).x);
    }
    if (has_samples) {
        vec4 sum = constants.sample_index == 0u ? color : imageLoad(sum_image, at) + color;
        imageStore(sum_image, at, sum);
        color = sum / float(constants.sample_index + 1u);
    }
    if (!is_last) {
        return;
    }
    uint index = pixel.y * constants.width + pixel.x;
    if (keeps_floats) {
        color = is_transparent ? lifted_off(constants.paper_color, color.rgb, color.a) : color;
        for (uint i = 0u; i < 4u; ++i) {
            pixels[4u * index + i] = floatBitsToUint(color[i]);
        }
    } else {
        pixels[index] = is_transparent
                            ? straight_srgb_bytes(constants.paper_color, color.rgb, color.a, color.rgb)
                            : srgb_bytes(color.rgb);
    }
}
