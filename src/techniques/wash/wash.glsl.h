// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_WASH_GLSL_H
#define ESTAMPE_WASH_GLSL_H
#include "shaders/tone.glsl.h"
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of `variant` of wash.comp.
SHARED_CONSTANT uint wash_has_air = 1U << 0U;    // colours turn pale with distance (aerial perspective)
SHARED_CONSTANT uint wash_has_screen = 1U << 1U; // there are transparent surfaces
SHARED_CONSTANT uint wash_has_background = 1U << 2U;
// Only surfaces of the variant `style_variant` are painted.
SHARED_CONSTANT uint wash_is_of_one_variant = 1U << 3U;
SHARED_CONSTANT uint wash_keeps_cover = 1U << 4U; // the wash stores the coverage by objects in alpha
SHARED_CONSTANT uint wash_has_shade = 1U << 5U;   // some surface has a second colour for the shade

struct WashConstants {
    ToneConstants tone;
    vec3 shadow_tint;    // colour by which surfaces in shadow are multiplied
    float shadow_from;   // darkness of the drawing at which shadow begins
    float softness;      // half the width of the shadow's soft edge, in darkness
    float ground_shadow; // strength of shadow_tint on blank ground, 0 to 1
    float detail;        // 0: the material's mean colour; 1: the material's texture
    float least;         // brightness towards which dark colours are lifted
    float strength;      // strength of the paint; 0: bare paper, 1: full colour
    float neutral;       // strength of the paint on grey materials, as a share
    float saturation;    // saturation; 0: greys only, 1: the materials' colours
    float light_tint;    // strength with which coloured light tints surfaces
    float air;           // share of air_color in colours at infinite distance
    vec3 air_color;
    float air_distance_m;
    vec3 spot_color;    // colour of a single printing ink
    float spot;         // share of spot_color in the painted colours, 0 to 1
    uint style_variant; // number of the style variant to paint
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
