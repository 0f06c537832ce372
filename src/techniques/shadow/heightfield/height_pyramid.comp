// SPDX-License-Identifier: MIT
// One thread per cell between four texels: the maximum of their heights.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/heightfield/height_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D height_image;
layout(binding = 1, r32f) writeonly uniform image2D out_greatest;

layout(push_constant, scalar) uniform Constants
{
    PyramidConstants pyramid;
};

#include "techniques/shadow/heightfield/height_pyramid.glsl"

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(pyramid.cells)))) {
        return;
    }
    ivec2 corner = place_of_texel(cell);
    float greatest = texelFetch(height_image, corner, 0).x;
    greatest = max(greatest, texelFetch(height_image, corner + ivec2(1, 0), 0).x);
    greatest = max(greatest, texelFetch(height_image, corner + ivec2(0, 1), 0).x);
    greatest = max(greatest, texelFetch(height_image, corner + ivec2(1, 1), 0).x);
    imageStore(out_greatest, place_of_cell(cell, 0u), vec4(greatest));
}
