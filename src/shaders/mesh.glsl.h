// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MESH_GLSL_H
#define ESTAMPE_MESH_GLSL_H
// The one kind of mesh that the renderer knows: what is uploaded, and what a pose makes of it.
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

#ifdef __cplusplus
static_assert(sizeof(RestVertex) == 48);
static_assert(sizeof(DrawRecord) == 112);
static_assert(sizeof(PosedVertex) == 16);
} // namespace estampe::shared
#endif

#endif
