// SPDX-License-Identifier: MIT
// What a corner of a triangle hands on, for the vertex shaders that find the triangle.

layout(location = 0) flat out uint triangle_drawn;
layout(location = 1) flat out uint triangle_flags;

layout(constant_id = 0) const uint variant = 0u;

invariant gl_Position; // layers are peeled by exact depth, by pipelines that are not the same

void draw_corner(uint triangle, uint corner)
{
    uvec4 corners = triangle_at(triangle);
    uint vertex = corner == 0u ? corners.x : corner == 1u ? corners.y : corners.z;
    gl_Position = constants.clip_from_anchor * vec4(posed_vertex_at(vertex).position, 1.0);
    triangle_drawn = triangle;
    bool are_wanted = (variant & draw_tests_sides) != 0u || constants.second != 0u;
    triangle_flags = are_wanted ? corners.w : 0u;
}
