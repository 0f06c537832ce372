// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MATERIAL_GLSL_H
#define ESTAMPE_MATERIAL_GLSL_H
// Materials as the shaders see them. Textures live in array images, one array per size class; a slot says
// where.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

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
static_assert(sizeof(TextureSlot) == 32);
static_assert(sizeof(MaterialRecord) == 176);
} // namespace estampe::shared
#endif

#endif
