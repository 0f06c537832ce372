// SPDX-License-Identifier: MIT
// One thread clears one pixel of the ink layer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

// The ink layer: square root of the ink's linear colour in rgb, coverage in alpha.
layout(binding = 0, rgba8) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    InkConstants constants;
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x < constants.width && pixel.y < constants.height) {
        imageStore(out_ink, ivec2(pixel), vec4(sqrt(constants.ink_color), 0.0));
    }
}
