// SPDX-License-Identifier: MIT
// Alpha masks: whether the texture leaves a pixel of a triangle standing. MASK_BINDING is the first of eight
// bindings; CLIP_FROM_ANCHOR and PICTURE_PX name the view.

#include "shaders/material.glsl.h"
#include "shaders/barycentric.glsl"

layout(scalar, binding = MASK_BINDING) readonly buffer Draws
{
    DrawRecord draws[];
};

layout(scalar, binding = MASK_BINDING + 1) readonly buffer RestVertices
{
    RestVertex rest_vertices[];
};

layout(scalar, binding = MASK_BINDING + 2) readonly buffer Materials
{
    MaterialRecord materials[];
};

layout(binding = MASK_BINDING + 3) uniform sampler2DArray texture_class_0;
layout(binding = MASK_BINDING + 4) uniform sampler2DArray texture_class_1;
layout(binding = MASK_BINDING + 5) uniform sampler2DArray texture_class_2;
layout(binding = MASK_BINDING + 6) uniform sampler2DArray texture_class_3;
layout(binding = MASK_BINDING + 7) uniform sampler2DArray texture_class_4;

// The size classes that hold textures.
layout(constant_id = 0) const uint variant = 31u;
#define TEXTURE_CLASSES variant

#include "shaders/texture.glsl"

bool passes_mask(uint triangle, ivec2 pixel)
{
    uvec4 corners = triangles[triangle];
    DrawRecord draw = draws[corners.w & TRIANGLE_DRAW_MASK];
    MaterialRecord material = materials[draw.material];
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    vec4 vertex_alpha =
        vec4(unpackUnorm4x8(rest_vertices[rest.x].color).a, unpackUnorm4x8(rest_vertices[rest.y].color).a,
             unpackUnorm4x8(rest_vertices[rest.z].color).a, 0.0);
    Barycentric b = barycentric_at(CLIP_FROM_ANCHOR * vec4(posed_vertices[corners.x].position, 1.0),
                                   CLIP_FROM_ANCHOR * vec4(posed_vertices[corners.y].position, 1.0),
                                   CLIP_FROM_ANCHOR * vec4(posed_vertices[corners.z].position, 1.0),
                                   vec2(pixel) + 0.5, PICTURE_PX);
    float alpha = material.base_color.a * dot(b.weight, vertex_alpha.xyz);
    if (material.base_texture.location != NO_TEXTURE) {
        bool second = ((material.base_texture.location >> 24) & 1u) != 0u;
        vec2 u0 = second ? rest_vertices[rest.x].uv_1 : rest_vertices[rest.x].uv_0;
        vec2 u1 = second ? rest_vertices[rest.y].uv_1 : rest_vertices[rest.y].uv_0;
        vec2 u2 = second ? rest_vertices[rest.z].uv_1 : rest_vertices[rest.z].uv_0;
        mat3x2 uv = mat3x2(u0, u1, u2);
        alpha *= sample_texture(material.base_texture, UvFootprint(uv * b.weight, uv * b.dx, uv * b.dy)).a;
    }
    return alpha >= material.alpha_cutoff;
}
