// SPDX-License-Identifier: MIT
// One thread per pixel: the larger of this picture's ink and the faded ink of the previous pictures.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "afterglow.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D ink_image;

layout(scalar, binding = 1) buffer Memory
{
    float memory[]; // ink of the previous picture, row by row
};

layout(binding = 2, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    AfterglowConstants constants;
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, constants.size_px))) {
        return;
    }
    uint place = pixel.y * constants.size_px.x + pixel.x;
    float ink = texelFetch(ink_image, ivec2(pixel), 0).x;
    // The content of a new buffer is undefined. It may be NaN, so it must not be multiplied.
    float left = constants.kept > 0.0 ? constants.kept * memory[place] : 0.0;
    memory[place] = max(ink, left);
    imageStore(out_ink, ivec2(pixel), vec4(memory[place]));
}
