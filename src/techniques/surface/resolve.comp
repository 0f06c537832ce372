// SPDX-License-Identifier: MIT
// One thread a pixel turns the identity of a triangle into the surface seen there: shading normal and smooth normal,
// colour, the coordinate that strokes follow and how it changes over the pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/footprint.glsl"
#include "shaders/material.glsl.h"
#include "shaders/mesh.glsl.h"
#include "shaders/octahedral.glsl"
#include "shaders/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame { FrameGlobals frame; };
layout(scalar, binding = 1) readonly buffer Visibility { uvec2 visibility[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) readonly buffer PosedVertices { PosedVertex posed_vertices[]; };
layout(scalar, binding = 4) readonly buffer Draws { DrawRecord draws[]; };
layout(scalar, binding = 5) readonly buffer RestVertices { RestVertex rest_vertices[]; };
layout(scalar, binding = 6) readonly buffer StrokeCoordinates { vec3 stroke_coordinates[]; };
layout(scalar, binding = 7) readonly buffer Materials { MaterialRecord materials[]; };
layout(binding = 8) uniform sampler2DArray texture_class_0;
layout(binding = 9) uniform sampler2DArray texture_class_1;
layout(binding = 10) uniform sampler2DArray texture_class_2;
layout(binding = 11) uniform sampler2DArray texture_class_3;
layout(binding = 12) uniform sampler2DArray texture_class_4;
layout(binding = 13, r32ui) writeonly uniform uimage2D out_draw;    // draw + 1, 0 for nothing
layout(binding = 14, r32f) writeonly uniform image2D out_depth;     // reversed, 0 for nothing
layout(binding = 15, rgba16f) writeonly uniform image2D out_normal; // octahedral: shading, smooth geometric
layout(binding = 16, rgba8) writeonly uniform image2D out_color;    // square root of linear colour; alpha
layout(binding = 17, rgba32f) writeonly uniform image2D out_coordinate;
layout(binding = 18, rgba32ui) writeonly uniform uimage2D out_footprint;

#include "shaders/texture.glsl"

UvFootprint uv_at(uvec3 rest, uint uv_set, Barycentric b)
{
    mat3x2 uv = uv_set == 0u ? mat3x2(rest_vertices[rest.x].uv_0, rest_vertices[rest.y].uv_0, rest_vertices[rest.z].uv_0)
                             : mat3x2(rest_vertices[rest.x].uv_1, rest_vertices[rest.y].uv_1, rest_vertices[rest.z].uv_1);
    return UvFootprint(uv * b.weight, uv * b.dx, uv * b.dy);
}

// Turns a tangent-space normal by the frame that position and texture coordinate span on the page: Schueler, "Normal
// Mapping without Precomputed Tangents", 2006.
vec3 perturb(vec3 normal, vec3 mapped, vec3 position_dx, vec3 position_dy, UvFootprint f)
{
    vec3 across = cross(position_dy, normal);
    vec3 along = cross(normal, position_dx);
    vec3 tangent = across * f.dx.x + along * f.dy.x;
    vec3 bitangent = across * f.dx.y + along * f.dy.y;
    float longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
    if (longest <= 0.0) {
        return normal;
    }
    // Down the page is the second direction, so the two span a left-handed frame where they face the eye.
    float inverse = inversesqrt(longest) * (dot(cross(position_dx, position_dy), normal) < 0.0 ? -1.0 : 1.0);
    vec3 turned = tangent * inverse * mapped.x - bitangent * inverse * mapped.y + normal * mapped.z;
    return normalize(turned);
}

void store_nothing(ivec2 pixel)
{
    imageStore(out_draw, pixel, uvec4(0u));
    imageStore(out_depth, pixel, vec4(0.0));
    imageStore(out_normal, pixel, vec4(0.0));
    imageStore(out_color, pixel, vec4(0.0));
    imageStore(out_coordinate, pixel, vec4(0.0));
    imageStore(out_footprint, pixel, uvec4(0u));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility[uint(pixel.y) * frame.size_px.x + uint(pixel.x)];
    if (!sees_triangle(seen)) {
        store_nothing(pixel);
        return;
    }
    uvec4 corners = triangles[seen_triangle(seen)];
    uint draw_index = corners.w & TRIANGLE_DRAW_MASK;
    PosedVertex a = posed_vertices[corners.x];
    PosedVertex b = posed_vertices[corners.y];
    PosedVertex c = posed_vertices[corners.z];
    Barycentric at = barycentric_at(frame.clip_from_anchor * vec4(a.position, 1.0),
                                    frame.clip_from_anchor * vec4(b.position, 1.0),
                                    frame.clip_from_anchor * vec4(c.position, 1.0), vec2(pixel) + 0.5, frame.size_px);
    mat3 positions = mat3(a.position, b.position, c.position);
    mat3 normals = mat3(octahedral_decode(unpackSnorm2x16(a.normal)), octahedral_decode(unpackSnorm2x16(b.normal)),
                        octahedral_decode(unpackSnorm2x16(c.normal)));
    vec3 smooth_normal = normalize(normals * at.weight + 1e-12);
    vec3 eye = towards_eye(frame, positions * at.weight);
    vec3 flat_normal = cross(b.position - a.position, c.position - a.position);
    float facing = dot(flat_normal, eye) * ((corners.w & TRIANGLE_MIRRORED) != 0u ? -1.0 : 1.0);
    smooth_normal = facing < 0.0 ? -smooth_normal : smooth_normal;

    uint first_posed = draws[draw_index].first_posed_vertex;
    uvec3 rest = corners.xyz - first_posed + draws[draw_index].first_rest_vertex;
    MaterialRecord material = materials[draws[draw_index].material];
    mat3 vertex_colors = mat3(unpackUnorm4x8(rest_vertices[rest.x].color).rgb, unpackUnorm4x8(rest_vertices[rest.y].color).rgb,
                              unpackUnorm4x8(rest_vertices[rest.z].color).rgb);
    vec3 tint = vertex_colors * at.weight;
    vec4 color = vec4(material.base_color.rgb * tint * tint, material.base_color.a);
    if (material.base_texture.location != NO_TEXTURE) {
        vec4 texel = sample_texture(material.base_texture, uv_at(rest, (material.base_texture.location >> 24) & 1u, at));
        color *= vec4(linear_from_srgb(texel.rgb), texel.a);
    }
    vec3 shading_normal = smooth_normal;
    if (material.normal_texture.location != NO_TEXTURE) {
        UvFootprint f = uv_at(rest, (material.normal_texture.location >> 24) & 1u, at);
        vec3 mapped = 2.0 * sample_texture(material.normal_texture, f).xyz - 1.0;
        mapped.xy *= material.normal_scale;
        shading_normal = perturb(smooth_normal, mapped, positions * at.dx, positions * at.dy, f);
    }

    vec3 coordinate;
    Footprint footprint;
    if (draws[draw_index].strokes_follow_uv != 0u) {
        UvFootprint f = uv_at(rest, 0u, at);
        coordinate = vec3(f.uv, 0.0);
        footprint = Footprint(vec3(f.dx, 0.0), vec3(f.dy, 0.0));
    } else {
        mat3 coordinates = mat3(stroke_coordinates[corners.x], stroke_coordinates[corners.y], stroke_coordinates[corners.z]);
        coordinate = coordinates * at.weight;
        footprint = Footprint(coordinates * at.dx, coordinates * at.dy);
    }
    imageStore(out_draw, pixel, uvec4(draw_index + 1u));
    imageStore(out_depth, pixel, vec4(seen_depth(seen)));
    imageStore(out_normal, pixel, vec4(octahedral_encode(shading_normal), octahedral_encode(smooth_normal)));
    imageStore(out_color, pixel, vec4(sqrt(clamp(color.rgb, 0.0, 1.0)), color.a));
    imageStore(out_coordinate, pixel, vec4(coordinate, 0.0));
    imageStore(out_footprint, pixel, pack_footprint(footprint));
}
