// SPDX-License-Identifier: MIT
// One thread per pixel writes the depth at which the view ray leaves the visible body: the depth of the next
// surface behind the visible one, if one of the two faces the eye and the other turns its back. Otherwise the
// visible surface is an open sheet, whose thickness is not known, and the depth is 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/visibility.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usamplerBuffer visible;
layout(binding = 2) uniform usamplerBuffer behind; // next surfaces behind the visible ones

#define MESH_TEXELS_BINDING 3
#include "shaders/mesh_texels.glsl"

layout(binding = 5, r32f) writeonly uniform image2D out_back;

// Whether the eye sees the counter-clockwise side of a triangle.
bool faces_eye(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    bool is_mirrored = (corners.w & triangle_mirrored) != 0u;
    return (dot(cross(b - a, c - a), towards_eye(frame, a)) > 0.0) != is_mirrored;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    int index = pixel.y * int(frame.size_px.x) + pixel.x;
    uvec2 front = texelFetch(visible, index).xy;
    uvec2 back = texelFetch(behind, index).xy;
    float depth = 0.0;
    if (sees_triangle(front) && sees_triangle(back) &&
        faces_eye(seen_triangle(front)) != faces_eye(seen_triangle(back))) {
        depth = seen_depth(back);
    }
    imageStore(out_back, pixel, vec4(depth));
}
