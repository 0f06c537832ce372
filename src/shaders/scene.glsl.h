// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCENE_GLSL_H
#define ESTAMPE_SCENE_GLSL_H
// The scene in shaders: the single mesh format of the renderer, as uploaded and as posed, and materials.
// Textures are layers of array images, one array per class of sizes; a TextureSlot locates one texture.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_skin = 0xffffffffU;

// Flags of a DrawRecord. The flag `draw_has_uv` means that the mesh has UVs.
SHARED_CONSTANT uint draw_has_uv = 1U;
SHARED_CONSTANT uint draw_follows_uv = 2U;  // the UVs are suitable for strokes
SHARED_CONSTANT uint draw_mirrored = 4U;    // the draw call's transform mirrors the mesh
SHARED_CONSTANT uint draw_unshadowed = 8U;  // no shadow falls on the draw call's surfaces
SHARED_CONSTANT uint draw_is_cut = 16U;     // alpha cuts or fades the surface, so it may end before its edges
SHARED_CONSTANT uint draw_is_foliage = 32U; // leaves: alpha cuts out a good part of the surface
SHARED_CONSTANT uint draw_is_round = 64U;   // the surface is curved all around, as that of a body

// Masks of the fourth word of a triangle, which holds the number of the draw call and flags.
SHARED_CONSTANT uint triangle_mirrored = 1U << 31U;
SHARED_CONSTANT uint triangle_two_sided = 1U << 30U;
// Of triangles of the line mesh only: the triangle belongs to a flat face, whatever its vertex normals say,
// or it has no lines.
SHARED_CONSTANT uint triangle_is_flat = 1U << 29U;
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

// Joints that move a vertex, up to eight: joint indices in 16-bit pairs, weights in unsigned normalised
// 16-bit pairs.
struct SkinVertex {
    uvec4 joints;
    uvec4 weights;
};

struct MorphOffset {
    vec3 position;
    vec3 normal;
};

// Record of a draw call, which draws one mesh primitive of one node: seven texels of 16 bytes, see
// shaders/draw_texels.glsl.
struct DrawRecord {
    mat4 anchor_from_object;
    uint first_posed_vertex;
    uint first_rest_vertex;
    uint material;
    uint object; // number of the node; outlines are drawn around all primitives of one object
    uint vertex_count;
    uint first_skin_vertex; // first SkinVertex of the mesh; no_skin for a rigid mesh
    uint first_joint;       // index of the first joint matrix (from bind pose to anchor space)
    uint first_morph_offset;
    uint morph_target_count;
    uint first_morph_weight;
    uint flags;
    // Bits 0-15: light groups that light the draw call; bits 16-31: light groups for which it casts shadows.
    uint groups;
};

// A posed vertex: position in anchor space (relative to an origin near the camera), and a normal packed as in
// RestVertex.
struct PosedVertex {
    vec3 position;
    uint normal;
};

SHARED_CONSTANT uint no_texture = 0xffffffffU;
// Bits of `variant`: one per class of texture sizes that contains textures.
SHARED_CONSTANT uint texture_class_mask = 31U;
SHARED_CONSTANT uint material_unlit = 1U;
// Blank paper: the surface receives shadow, but has no wash and no outline.
SHARED_CONSTANT uint material_paper = 2U;
SHARED_CONSTANT uint material_emissive = 4U;
SHARED_CONSTANT float least_cover = 0.02F; // smallest alpha with which a transparent surface is visible

// Location of a texture, and the transform of texture coordinates u and v: the texture is sampled at
// `column_u * u + column_v * v + offset`.
struct TextureSlot {
    // no_texture, or bits: size class 0-3, layer 4-23, UV set 24, wrap mode of u 25-26, of v 27-28.
    uint location;
    vec2 column_u;
    vec2 column_v;
    vec2 offset;
    float strength; // strength of a normal or occlusion texture; usually 0 to 1
};

// A material: eleven texels of 16 bytes, see shaders/material_texels.glsl.
struct MaterialRecord {
    vec4 base_color;
    vec3 mean_color; // mean colour of the texture, times the colour factor, for flat washes
    uint flags;
    vec3 shade_color; // factor on the wash where the surface is in shadow
    // Alpha below which a surface is invisible: cutoff of masked materials, least_cover for transparent ones.
    float alpha_cutoff;
    vec3 outline_color;    // colour of the material's own outline; only used if outline_width_m is not 0
    float outline_width_m; // width of the material's own outline; 0: the width of the style's outline
    vec3 emissive;
    float unused;
    TextureSlot base_texture;
    TextureSlot normal_texture;
    TextureSlot occlusion_texture; // its red channel: share of light that passes is 1 + strength * (red - 1)
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
