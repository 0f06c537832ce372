// SPDX-License-Identifier: MIT
// One corner of one triangle of a list of those that are worth it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/draw.glsl"

#include "techniques/raster/corner.glsl"

layout(binding = 2) uniform usamplerBuffer listed; // numbers within the batch

void main()
{
    uint number = texelFetch(listed, gl_VertexIndex / 3).x;
    draw_corner(constants.first_triangle + number, uint(gl_VertexIndex) % 3u);
}
