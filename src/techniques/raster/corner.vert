// SPDX-License-Identifier: MIT
// One corner of one triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/draw.glsl"

layout(location = 0) flat out uint triangle_drawn;
layout(location = 1) flat out uint triangle_flags;

layout(constant_id = 0) const uint variant = 0u;

invariant gl_Position; // layers are peeled by exact depth, by pipelines that are not the same

void main()
{
    uint triangle = constants.first_triangle + uint(gl_VertexIndex) / 3u;
    uvec4 corners = triangle_at(triangle);
    uint corner = uint(gl_VertexIndex) % 3u;
    uint vertex = corner == 0u ? corners.x : corner == 1u ? corners.y : corners.z;
    gl_Position = constants.clip_from_anchor * vec4(posed_vertex_at(vertex).position, 1.0);
    triangle_drawn = triangle;
    triangle_flags = (variant & draw_tests_sides) != 0u ? corners.w : 0u;
}
