// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCENE_GLSL_H
#define ESTAMPE_SCENE_GLSL_H
// The scene in shaders: the single mesh format of the renderer, as uploaded and as posed, and materials.
// Textures are layers of array images, one array per size class; a TextureSlot locates one.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_skin = 0xffffffffU;

// Flags of DrawRecord.
SHARED_CONSTANT uint draw_has_uv = 1U;
SHARED_CONSTANT uint draw_follows_uv = 2U; // the draw's UVs are suitable for strokes
SHARED_CONSTANT uint draw_mirrored = 4U;   // the draw's transform mirrors the mesh
SHARED_CONSTANT uint draw_unshadowed = 8U; // the draw receives no shadow
SHARED_CONSTANT uint draw_is_cut = 16U;    // alpha cuts or fades the draw, so it may end before its edges

// Masks of a triangle's fourth word: the number of the draw, and two flags for the rasteriser.
SHARED_CONSTANT uint triangle_mirrored = 1U << 31U;
SHARED_CONSTANT uint triangle_two_sided = 1U << 30U;
SHARED_CONSTANT uint triangle_draw_mask = (1U << 28U) - 1U;

// A vertex of the rest pose: three texels of 16 bytes, see shaders/rest_texels.glsl. The normal is
// octahedral with two signed 16-bit parts; the colour has four unsigned 8-bit parts.
struct RestVertex {
    vec3 position;
    uint normal;
    vec2 uv_0;
    vec2 uv_1;
    uint color;
    uvec3 unused;
};

// Up to eight joint influences: joint indices in 16-bit pairs, weights in unsigned normalised 16-bit pairs.
struct SkinVertex {
    uvec4 joints;
    uvec4 weights;
};

struct MorphOffset {
    vec3 position;
    vec3 normal;
};

// One mesh primitive of one node: seven texels of 16 bytes, see shaders/draw_texels.glsl.
struct DrawRecord {
    mat4 anchor_from_object;
    uint first_posed_vertex;
    uint first_rest_vertex;
    uint material;
    uint object; // Node number; outlines are drawn around all primitives of one object
    uint vertex_count;
    uint first_skin_vertex; // no_skin for a rigid mesh
    uint first_joint;       // Index into the joint matrices, anchor_from_bind
    uint first_morph_offset;
    uint morph_target_count;
    uint first_morph_weight;
    uint flags;
    // Bits 0-15: light groups that light the draw; bits 16-31: light groups for which the draw casts shadows.
    uint groups;
};

// Position in anchor space; normal as in RestVertex.
struct PosedVertex {
    vec3 position;
    uint normal;
};

SHARED_CONSTANT uint no_texture = 0xffffffffU;
SHARED_CONSTANT uint texture_class_mask = 31U; // Variant bits: one per size class that contains textures
SHARED_CONSTANT uint material_unlit = 1U;
SHARED_CONSTANT uint material_paper = 2U; // receives shadow, but has no wash and no outline
SHARED_CONSTANT uint material_emissive = 4U;
SHARED_CONSTANT float least_cover = 0.02F; // Least alpha of a visible blended surface

// Location of a texture and transform of its coordinates: uv' = column_u * u + column_v * v + offset.
struct TextureSlot {
    // no_texture, or bits: size class 0-3, layer 4-23, UV set 24, wrap of u 25-26, wrap of v 27-28.
    uint location;
    vec2 column_u;
    vec2 column_v;
    vec2 offset;
    float strength; // Strength of a normal or occlusion texture; usually 0 to 1
};

// A material: eleven texels of 16 bytes, see shaders/material_texels.glsl.
struct MaterialRecord {
    vec4 base_color;
    vec3 mean_color; // Mean of texture times factor, for flat washes
    uint flags;
    vec3 shade_color;      // Multiplied into the wash in shadow
    float alpha_cutoff;    // Cutoff of masked materials; least_cover for blended ones
    vec3 outline_color;    // Only used if outline_width_m is not 0
    float outline_width_m; // 0 means the width of the style's outline
    vec3 emissive;
    float unused;
    TextureSlot base_texture;
    TextureSlot normal_texture;
    TextureSlot occlusion_texture; // red: share of light that passes is 1 + strength * (red - 1)
};

#ifdef __cplusplus
static_assert(sizeof(RestVertex) == 48);
static_assert(sizeof(DrawRecord) == 112);
static_assert(sizeof(PosedVertex) == 16);
static_assert(sizeof(TextureSlot) == 32);
static_assert(sizeof(MaterialRecord) == 176);
} // namespace estampe::shared
#endif

#endif
