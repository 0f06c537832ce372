// SPDX-License-Identifier: MIT
// One thread looks through one pixel: the nearest see-through surface in front of the solid ones, its colour
// and how much it covers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/color.glsl"
#include "shaders/frame.glsl.h"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) readonly buffer SolidVisibility
{
    uvec2 solid[];
};

layout(scalar, binding = 2) readonly buffer ScreenVisibility
{
    uvec2 screen[];
};

#define MESH_TEXELS_BINDING 3
#include "shaders/mesh_texels.glsl"

#define DRAW_TEXELS_BINDING 5
#include "shaders/draw_texels.glsl"

layout(scalar, binding = 6) readonly buffer RestVertices
{
    RestVertex rest_vertices[];
};

#define MATERIAL_TEXELS_BINDING 7
#include "shaders/material_texels.glsl"

layout(binding = 8) uniform sampler2DArray texture_class_0;
layout(binding = 9) uniform sampler2DArray texture_class_1;
layout(binding = 10) uniform sampler2DArray texture_class_2;
layout(binding = 11) uniform sampler2DArray texture_class_3;
layout(binding = 12) uniform sampler2DArray texture_class_4;
layout(binding = 13, r32ui) writeonly uniform uimage2D out_draw; // draw + 1, 0 for none
layout(binding = 14, rgba8) writeonly uniform image2D out_color; // square root of linear colour; cover

// The size classes that hold textures.
layout(constant_id = 0) const uint variant = 31u;
#define TEXTURE_CLASSES variant

#include "shaders/texture.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_draw)))) {
        return;
    }
    uint index = uint(pixel.y) * frame.size_px.x + uint(pixel.x);
    uvec2 seen = screen[index];
    if (!sees_triangle(seen) || seen_depth(seen) <= seen_depth(solid[index])) {
        imageStore(out_draw, pixel, uvec4(0u));
        imageStore(out_color, pixel, vec4(0.0));
        return;
    }
    uvec4 corners = triangle_at(seen_triangle(seen));
    uint draw_index = corners.w & TRIANGLE_DRAW_MASK;
    DrawPart draw = draw_at(draw_index);
    Barycentric at = barycentric_at(frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0),
                                    vec2(pixel) + 0.5, frame.size_px);
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    mat3x4 vertex_colors =
        mat3x4(vertex_color(rest_vertices[rest.x].color), vertex_color(rest_vertices[rest.y].color),
               vertex_color(rest_vertices[rest.z].color));
    vec4 color = base_color_of(draw.material) * (vertex_colors * at.weight);
    TextureSlot slot = base_texture_of(draw.material);
    if (TEXTURE_CLASSES != 0u && slot.location != NO_TEXTURE) {
        bool second = ((slot.location >> 24) & 1u) != 0u;
        mat3x2 uv =
            second
                ? mat3x2(rest_vertices[rest.x].uv_1, rest_vertices[rest.y].uv_1, rest_vertices[rest.z].uv_1)
                : mat3x2(rest_vertices[rest.x].uv_0, rest_vertices[rest.y].uv_0, rest_vertices[rest.z].uv_0);
        vec4 texel = sample_texture(slot, UvFootprint(uv * at.weight, uv * at.dx, uv * at.dy));
        color *= vec4(linear_from_srgb(texel.rgb), texel.a);
    }
    float cover = clamp(color.a, 0.0, 1.0);
    imageStore(out_draw, pixel, uvec4(cover >= LEAST_COVER ? draw_index + 1u : 0u));
    imageStore(out_color, pixel, vec4(sqrt(clamp(color.rgb, 0.0, 1.0)), cover));
}
