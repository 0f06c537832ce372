// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCENE_GLSL_H
#define ESTAMPE_SCENE_GLSL_H
// The scene as shaders see it: the one kind of mesh that the renderer knows, what is uploaded and what a pose
// makes of it, and materials. Textures live in array images, one array per size class; a slot says where.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_skin = 0xffffffffU;

// Flags of DrawRecord.
SHARED_CONSTANT uint draw_has_uv = 1U;
SHARED_CONSTANT uint draw_follows_uv = 2U; // its UVs can carry strokes
SHARED_CONSTANT uint draw_mirrored = 4U;   // its place turns it inside out
SHARED_CONSTANT uint draw_unshadowed = 8U; // receives no shadow
SHARED_CONSTANT uint draw_is_cut =
    16U; // by its material's alpha, or wholly clear: it does not end where its edges are

// A triangle's fourth number: the draw, and two flags that the rasteriser needs at once.
SHARED_CONSTANT uint triangle_mirrored = 1U << 31U;
SHARED_CONSTANT uint triangle_two_sided = 1U << 30U;
SHARED_CONSTANT uint triangle_draw_mask = (1U << 28U) - 1U;

// A vertex as the file has it, three texels of 16 bytes, see shaders/rest_texels.glsl. Normal octahedral in
// two signed 16-bit parts; colour in four unsigned 8-bit parts.
struct RestVertex {
    vec3 position;
    uint normal;
    vec2 uv_0;
    vec2 uv_1;
    uint color;
    uvec3 unused;
};

// Up to eight influences: joint numbers in 16-bit pairs, weights in unsigned normalised 16-bit pairs.
struct SkinVertex {
    uvec4 joints;
    uvec4 weights;
};

struct MorphOffset {
    vec3 position;
    vec3 normal;
};

// One mesh primitive in one place of the scene: seven texels of 16 bytes, see shaders/draw_texels.glsl.
struct DrawRecord {
    mat4 anchor_from_object;
    uint first_posed_vertex;
    uint first_rest_vertex;
    uint material;
    uint object; // what an outline goes around: one number a node
    uint vertex_count;
    uint first_skin_vertex; // no_skin: rigid
    uint first_joint;       // into the joint matrices, anchor_from_bind
    uint first_morph_offset;
    uint morph_target_count;
    uint first_morph_weight;
    uint flags;
    uint groups; // lit by those of bits 0-15, throws shadows for those of bits 16-31
};

// Position relative to the anchor; normal as in RestVertex.
struct PosedVertex {
    vec3 position;
    uint normal;
};

SHARED_CONSTANT uint no_texture = 0xffffffffU;
SHARED_CONSTANT uint texture_class_mask = 31U; // of variants: a bit for each size class that holds anything
SHARED_CONSTANT uint material_unlit = 1U;
SHARED_CONSTANT uint material_paper = 2U; // takes shadow, but neither wash nor outline
SHARED_CONSTANT uint material_emissive = 4U;
SHARED_CONSTANT float least_cover = 0.02F; // of a blended surface that is seen at all

// Where a texture lives and how its coordinates are made: uv' = column_u * u + column_v * v + offset.
struct TextureSlot {
    uint location; // no_texture, or: size class in bits 0-3, layer in 4-23, UV set in 24, wrap of u in 25-26,
                   // of v in 27-28
    vec2 column_u;
    vec2 column_v;
    vec2 offset;
    float strength; // of a normal or an occlusion texture, 0 to 1 and more
};

// Eleven texels of 16 bytes, see shaders/material_texels.glsl.
struct MaterialRecord {
    vec4 base_color;
    vec3 mean_color; // of texture times factor: what a flat wash takes
    uint flags;
    vec3 shade_color;      // multiplied into the wash in shadow
    float alpha_cutoff;    // of masked materials; least_cover of blended ones
    vec3 outline_color;    // with an outline of its own
    float outline_width_m; // 0: the style's outline
    vec3 emissive;
    float unused;
    TextureSlot base_texture;
    TextureSlot normal_texture;
    TextureSlot occlusion_texture; // share of the light that gets through, in red: 1 + strength * (red - 1)
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
