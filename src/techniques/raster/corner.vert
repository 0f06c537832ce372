// SPDX-License-Identifier: MIT
// One corner of one triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/draw.glsl"

#include "techniques/raster/corner.glsl"

void main()
{
    draw_corner(constants.first_triangle + uint(gl_VertexIndex) / 3u, uint(gl_VertexIndex) % 3u);
}
