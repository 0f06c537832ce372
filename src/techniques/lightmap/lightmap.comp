// SPDX-License-Identifier: MIT
// One thread looks up the baked light of the surface that is visible at one pixel. Alpha is 1 on the front of
// triangles that have a lightmap, otherwise 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"
#include "shaders/visibility.glsl"
#include "techniques/lightmap/lightmap.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) readonly buffer Visibility
{
    uvec2 visibility[];
};

layout(scalar, binding = 4) readonly buffer Slots
{
    LightmapSlot slots[]; // the lightmap of each draw (mesh primitive)
};

layout(scalar, binding = 5) readonly buffer Corners
{
    vec2 map_corners[]; // UV coordinates in the lightmap, three per triangle
};

layout(binding = 6) uniform sampler2DArray maps;
layout(binding = 7, rgba16f) writeonly uniform image2D out_lightmap;

layout(push_constant) uniform Constants
{
    float scale;
}

constants; // factor from the exposure of the lightmaps to the exposure of the frame

vec4 light_at(ivec2 pixel)
{
    uvec2 seen = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
    if (!sees_triangle(seen)) {
        return vec4(0.0);
    }
    uvec4 corners = triangle_at(seen_triangle(seen));
    LightmapSlot slot = slots[corners.w & triangle_draw_mask];
    if (slot.layer == no_lightmap) {
        return vec4(0.0);
    }
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    Barycentric at = barycentric_at(
        frame.clip_from_anchor * vec4(a, 1.0), frame.clip_from_anchor * vec4(b, 1.0),
        frame.clip_from_anchor * vec4(c, 1.0), page_place(frame, vec2(pixel) + 0.5), frame.page_px);
    vec3 eye = towards_eye(frame, mat3(a, b, c) * at.weight);
    float facing = dot(cross(b - a, c - a), eye) * ((corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0);
    if (facing < 0.0) {
        return vec4(0.0);
    }
    uint first = 3u * seen_triangle(seen);
    mat3x2 uv = mat3x2(map_corners[first], map_corners[first + 1u], map_corners[first + 2u]);
    vec3 light = textureGrad(maps, vec3(uv * at.weight, float(slot.layer)), uv * at.dx, uv * at.dy).rgb;
    return vec4(light * (slot.strength * constants.scale), 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    imageStore(out_lightmap, pixel, light_at(pixel));
}
