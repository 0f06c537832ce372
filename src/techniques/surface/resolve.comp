// SPDX-License-Identifier: MIT
// One thread per pixel converts the visible triangle to surface attributes. The attributes are shading
// normal, smooth normal, colour, and the coordinate that strokes follow with its change per pixel. Background
// pixels get only draw, depth and a blank normal; the other images are undefined there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/surface_images.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/surface/resolve_variant.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

#define DRAW_TEXELS_BINDING 4
#include "shaders/draw_texels.glsl"

#define REST_TEXELS_BINDING 5
#include "shaders/rest_texels.glsl"

layout(scalar, binding = 6) readonly buffer StrokeCoordinates
{
    vec3 stroke_coordinates[];
};

#define MATERIAL_TEXELS_BINDING 7
#include "shaders/material_texels.glsl"

layout(scalar, binding = 8) readonly buffer StrokeKinds
{
    uint stroke_kinds[]; // kind of strokes of each draw call, see shaders/stroke_kind.glsl.h
};

layout(scalar, binding = 9) readonly buffer FormCoordinates
{
    vec2 form_coordinates[]; // coordinates of strokes along the form, three per triangle
};

layout(binding = 10) uniform sampler2DArray texture_class_0;
layout(binding = 11) uniform sampler2DArray texture_class_1;
layout(binding = 12) uniform sampler2DArray texture_class_2;
layout(binding = 13) uniform sampler2DArray texture_class_3;
layout(binding = 14) uniform sampler2DArray texture_class_4;
// Draw call and flags, see shaders/surface_images.glsl.
layout(binding = 15, r32ui) writeonly uniform uimage2D out_draw;
layout(binding = 16, r32f) writeonly uniform image2D out_depth; // reversed depth, 0 for the background
// Two packed normals: the shading normal, and the smooth geometric normal.
layout(binding = 17, rg32ui) writeonly uniform uimage2D out_normal;
// Square root of linear colour in rgb; occlusion in alpha.
layout(binding = 18, rgba8) writeonly uniform image2D out_color;
layout(binding = 19, rgba32f) writeonly uniform image2D out_coordinate;
layout(binding = 20, rgba32ui) writeonly uniform uimage2D out_footprint;

layout(push_constant) uniform Constants
{
    float strokes_per_m;
}

constants; // per_m: stroke coordinates per metre

layout(constant_id = 0) const uint variant = 0u;
const bool has_textures = (variant & texture_class_mask) != 0u;
const bool has_normal_maps = (variant & resolve_has_normal_maps) != 0u;
const bool has_vertex_colors = (variant & resolve_has_vertex_colors) != 0u;
const bool has_uv_strokes = (variant & resolve_has_uv_strokes) != 0u;
const bool has_second_uvs = (variant & resolve_has_second_uvs) != 0u;
const bool stands_still = (variant & resolve_stands_still) != 0u;
const bool has_form_strokes = (variant & resolve_has_form_strokes) != 0u;
const bool has_page_strokes = (variant & resolve_has_page_strokes) != 0u;
const bool has_occlusion = (variant & resolve_has_occlusion) != 0u;
#define TEXTURE_CLASSES variant

#include "shaders/texture.glsl"

UvFootprint uv_at(uvec3 rest, uint uv_set, Barycentric b)
{
    mat3x2 uv = mat3x2(rest_vertex_at(rest.x).uv_0, rest_vertex_at(rest.y).uv_0, rest_vertex_at(rest.z).uv_0);
    if (has_second_uvs && uv_set != 0u) {
        uv = mat3x2(rest_vertex_at(rest.x).uv_1, rest_vertex_at(rest.y).uv_1, rest_vertex_at(rest.z).uv_1);
    }
    return UvFootprint(uv * b.weight, uv * b.dx, uv * b.dy);
}

// Texels of a material's textures at a point of its surface; white without a texture.
struct Texels {
    vec4 base;
    vec4 normal;
    vec4 occlusion;
};

// Reads all textures of a material in one loop with a single lookup, because lookups are expensive to
// compile. CPUs skip a texture that no pixel of a subgroup needs.
Texels texels_at(uint material, uvec3 rest, Barycentric b)
{
    Texels texels = Texels(vec4(1.0), vec4(1.0), vec4(1.0));
    if (!has_textures) {
        return texels;
    }
    int slots = has_normal_maps && normal_texture_of(material).location != no_texture ? 2 : 1;
    slots = has_occlusion && occlusion_texture_of(material).location != no_texture ? 3 : slots;
    int i = 0;
    do {
        TextureSlot slot = texture_of(material, uint(i));
        vec4 texel = sample_texture(slot, uv_at(rest, uv_set_of(slot), b));
        texels.base = i == 0 ? texel : texels.base;
        texels.normal = i == 1 ? texel : texels.normal;
        texels.occlusion = i == 2 ? texel : texels.occlusion;
        ++i;
    } while (subgroupAny(i < slots));
    return texels;
}

// Transforms a tangent-space normal by the frame that the screen derivatives of position and texture
// coordinate span: Schueler, "Normal Mapping without Precomputed Tangents", 2006.
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
    // The page's y axis points down, so on surfaces that face the eye the two derivatives span a left-handed
    // frame.
    float inverse = inversesqrt(longest) * (dot(cross(position_dx, position_dy), normal) < 0.0 ? -1.0 : 1.0);
    vec3 turned = tangent * inverse * mapped.x - bitangent * inverse * mapped.y + normal * mapped.z;
    return unit(turned);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    uvec2 seen = visibility_at(pixel);
    if (!sees_triangle(seen)) {
        imageStore(out_draw, pixel, uvec4(0u));
        imageStore(out_depth, pixel, vec4(0.0));
        imageStore(out_normal, pixel, uvec4(0u));
        return;
    }
    uvec4 corners = triangle_at(seen_triangle(seen));
    uint draw_index = corners.w & triangle_draw_mask;
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    Barycentric at = barycentric_at(
        frame.clip_from_anchor * vec4(a.position, 1.0), frame.clip_from_anchor * vec4(b.position, 1.0),
        frame.clip_from_anchor * vec4(c.position, 1.0), page_place(frame, vec2(pixel) + 0.5), frame.page_px);
    mat3 positions = mat3(a.position, b.position, c.position);
    mat3 normals = mat3(unpack_normal(a.normal), unpack_normal(b.normal), unpack_normal(c.normal));
    vec3 smooth_normal = unit(normals * at.weight + 1e-12);
    vec3 eye = towards_eye(frame, positions * at.weight);
    vec3 flat_normal = cross(b.position - a.position, c.position - a.position);
    float facing = dot(flat_normal, eye) * ((corners.w & triangle_mirrored) != 0u ? -1.0 : 1.0);
    smooth_normal = facing < 0.0 ? -smooth_normal : smooth_normal;

    DrawPart draw = draw_at(draw_index);
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    vec3 color = base_color_of(draw.material).rgb;
    if (has_vertex_colors) {
        mat3 colors = mat3(vertex_color(rest_vertex_at(rest.x).color).rgb,
                           vertex_color(rest_vertex_at(rest.y).color).rgb,
                           vertex_color(rest_vertex_at(rest.z).color).rgb);
        color *= colors * at.weight;
    }
    vec3 shading_normal = smooth_normal;
    Texels texels = texels_at(draw.material, rest, at);
    if (has_textures && base_texture_of(draw.material).location != no_texture) {
        color *= linear_from_srgb(texels.base.rgb);
    }
    if (has_normal_maps) {
        TextureSlot slot = normal_texture_of(draw.material);
        if (slot.location != no_texture) {
            vec3 mapped = 2.0 * texels.normal.xyz - 1.0;
            mapped.xy *= slot.strength;
            shading_normal = perturb(smooth_normal, mapped, positions * at.dx, positions * at.dy,
                                     uv_at(rest, uv_set_of(slot), at));
        }
    }
    float open = 1.0; // visibility of ambient light, from the occlusion texture
    if (has_occlusion) {
        TextureSlot slot = occlusion_texture_of(draw.material);
        if (slot.location != no_texture) {
            open = 1.0 + slot.strength * (texels.occlusion.r - 1.0);
        }
    }

    mat3 coordinates = positions * constants.strokes_per_m;
    if (!stands_still) {
        coordinates =
            mat3(stroke_coordinates[corners.x], stroke_coordinates[corners.y], stroke_coordinates[corners.z]);
    }
    vec3 coordinate = coordinates * at.weight;
    Footprint footprint = Footprint(coordinates * at.dx, coordinates * at.dy);
    uint strokes = stroke_kinds[draw_index];
    if (has_uv_strokes && strokes == strokes_uv) {
        UvFootprint f = uv_at(rest, 0u, at);
        coordinate = vec3(f.uv, 0.0);
        footprint = Footprint(vec3(f.dx, 0.0), vec3(f.dy, 0.0));
    }
    if (has_form_strokes && strokes == strokes_form) {
        uint first = 3u * seen_triangle(seen);
        mat3x2 form =
            mat3x2(form_coordinates[first], form_coordinates[first + 1u], form_coordinates[first + 2u]);
        coordinate = vec3(form * at.weight, 0.0);
        footprint = Footprint(vec3(form * at.dx, 0.0), vec3(form * at.dy, 0.0));
    }
    if (has_page_strokes && strokes == strokes_page) {
        float mm_per_px = 1.0 / frame.pixels_per_mm;
        coordinate = vec3(page_place(frame, vec2(pixel) + 0.5) * mm_per_px, 0.0);
        footprint = Footprint(vec3(mm_per_px, 0.0, 0.0), vec3(0.0, mm_per_px, 0.0));
    }
    uint flags = flags_of(draw.material);
    uint word = (draw_index + 1u) | ((flags & material_paper) != 0u ? DRAW_PAPER : 0u) |
                ((flags & material_unlit) != 0u ? DRAW_UNLIT : 0u) |
                ((flags & material_emissive) != 0u ? DRAW_EMISSIVE : 0u) | (strokes << DRAW_STROKES_SHIFT);
    imageStore(out_draw, pixel, uvec4(word));
    imageStore(out_depth, pixel, vec4(seen_depth(seen)));
    imageStore(out_normal, pixel, uvec4(pack_normal(shading_normal), pack_normal(smooth_normal), 0u, 0u));
    imageStore(out_color, pixel, vec4(sqrt(clamp(color, 0.0, 1.0)), open));
    imageStore(out_coordinate, pixel, vec4(coordinate, 0.0));
    imageStore(out_footprint, pixel, pack_footprint(footprint));
}
