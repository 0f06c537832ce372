// SPDX-License-Identifier: MIT
// Alpha masks: tests whether the texture keeps a pixel of a triangle. MASK_BINDING is the first of eight
// bindings; CLIP_FROM_ANCHOR and PICTURE_PX name the view. LEAST_ALPHA and ALPHA_BELOW, if they are defined,
// limit the alpha of the texels.

#include "shaders/scene.glsl.h"
#include "shaders/barycentric.glsl"

#define DRAW_TEXELS_BINDING MASK_BINDING
#include "shaders/draw_texels.glsl"

layout(scalar, binding = MASK_BINDING + 1) readonly buffer RestVertices
{
    RestVertex rest_vertices[];
};

#define MATERIAL_TEXELS_BINDING (MASK_BINDING + 2)
#include "shaders/material_texels.glsl"

layout(binding = MASK_BINDING + 3) uniform sampler2DArray texture_class_0;
layout(binding = MASK_BINDING + 4) uniform sampler2DArray texture_class_1;
layout(binding = MASK_BINDING + 5) uniform sampler2DArray texture_class_2;
layout(binding = MASK_BINDING + 6) uniform sampler2DArray texture_class_3;
layout(binding = MASK_BINDING + 7) uniform sampler2DArray texture_class_4;

// One bit for each class of texture sizes that holds textures.
layout(constant_id = 0) const uint variant = 31u;
#define TEXTURE_CLASSES variant

#include "shaders/texture.glsl"

bool passes_mask(uint triangle, ivec2 pixel)
{
    uvec4 corners = triangle_at(triangle);
    DrawPart draw = draw_at(corners.w & triangle_draw_mask);
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    vec4 vertex_alpha =
        vec4(unpackUnorm4x8(rest_vertices[rest.x].color).a, unpackUnorm4x8(rest_vertices[rest.y].color).a,
             unpackUnorm4x8(rest_vertices[rest.z].color).a, 0.0);
    Barycentric b = barycentric_at(CLIP_FROM_ANCHOR * vec4(posed_vertex_at(corners.x).position, 1.0),
                                   CLIP_FROM_ANCHOR * vec4(posed_vertex_at(corners.y).position, 1.0),
                                   CLIP_FROM_ANCHOR * vec4(posed_vertex_at(corners.z).position, 1.0),
                                   vec2(pixel) + 0.5, PICTURE_PX);
    float alpha = base_color_of(draw.material).a * dot(b.weight, vertex_alpha.xyz);
    TextureSlot slot = base_texture_of(draw.material);
    if (slot.location != no_texture) {
        bool second = uv_set_of(slot) != 0u;
        vec2 u0 = second ? rest_vertices[rest.x].uv_1 : rest_vertices[rest.x].uv_0;
        vec2 u1 = second ? rest_vertices[rest.y].uv_1 : rest_vertices[rest.y].uv_0;
        vec2 u2 = second ? rest_vertices[rest.z].uv_1 : rest_vertices[rest.z].uv_0;
        mat3x2 uv = mat3x2(u0, u1, u2);
        alpha *= sample_texture(slot, UvFootprint(uv * b.weight, uv * b.dx, uv * b.dy)).a;
    }
#ifdef LEAST_ALPHA
    return alpha >= max(alpha_cutoff_of(draw.material), LEAST_ALPHA) && alpha < ALPHA_BELOW;
#else
    return alpha >= alpha_cutoff_of(draw.material);
#endif
}
