// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SURFACE_SHADE_GLSL_H
#define ESTAMPE_SURFACE_SHADE_GLSL_H
#include "shaders/scene.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Size class, in the location of a TextureSlot, of the pictures that a style names. The classes below it are
// those of the scene's textures.
SHARED_CONSTANT uint shade_picture_class = 5U;

// Bits of `variant` of shade.comp, in addition to texture_class_mask.
SHARED_CONSTANT uint shade_has_pictures = 1U << 5U; // some surface has a picture of the style
SHARED_CONSTANT uint shade_has_tiles = 1U << 7U;    // a list of tiles says where such surfaces are
SHARED_CONSTANT uint shade_has_steps = 1U << 6U;    // some surface has a step of its own, and the sun shines

// Flags of a ShadeRecord.
SHARED_CONSTANT uint shade_is_there = 1U; // the draw call has a shade colour
SHARED_CONSTANT uint shade_has_step = 2U; // `step_from` and `step_to` say where the draw call is in shade

// Colour of a draw call in the shade, and where the shade begins: five texels of 16 bytes.
struct ShadeRecord {
    TextureSlot texture;
    vec3 color; // linear factor on the texture
    uint flags;
    vec3 mean_color; // mean linear colour of the texture, times the factor
    float detail;    // 0: the mean colour; 1: the texture
    float step_from; // cosine of incidence up to which the surface is wholly in shade
    float step_to;   // cosine of incidence from which on the surface is wholly lit
    uvec2 unused;
};

struct ShadeConstants {
    vec3 towards_sun;
};

#ifdef __cplusplus
static_assert(sizeof(ShadeRecord) == 80);
} // namespace estampe::shared
#endif

#endif
