// SPDX-License-Identifier: MIT
// One corner of a triangle of a batch. If LISTED_BINDING is defined, LISTED_BINDING is the binding of a list
// of triangles to draw.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/hardware/draw.glsl"

layout(location = 0) flat out uint triangle_drawn;
layout(location = 1) flat out uint triangle_flags;

layout(constant_id = 0) const uint variant = 0u;

invariant gl_Position; // depth must be bit-identical in all pipelines, for depth peeling

void draw_corner(uint triangle, uint corner)
{
    uvec4 corners = triangle_at(triangle);
    uint vertex = corner == 0u ? corners.x : corner == 1u ? corners.y : corners.z;
    gl_Position = constants.clip_from_anchor * vec4(posed_vertex_at(vertex).position, 1.0);
    triangle_drawn = triangle;
    bool are_wanted = (variant & draw_tests_sides) != 0u || constants.second != 0u;
    triangle_flags = are_wanted ? corners.w : 0u;
}

#ifdef LISTED_BINDING
layout(binding = LISTED_BINDING) uniform usamplerBuffer listed; // triangle numbers within the batch

void main()
{
    uint number = texelFetch(listed, gl_VertexIndex / 3).x;
    draw_corner(constants.first_triangle + number, uint(gl_VertexIndex) % 3u);
}
#else
void main()
{
    draw_corner(constants.first_triangle + uint(gl_VertexIndex) / 3u, uint(gl_VertexIndex) % 3u);
}
#endif
