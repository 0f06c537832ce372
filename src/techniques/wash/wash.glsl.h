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

// Variant bits of wash.comp.
SHARED_CONSTANT uint wash_has_air = 1U << 0U;    // colours turn pale with distance
SHARED_CONSTANT uint wash_has_screen = 1U << 1U; // there are transparent surfaces
SHARED_CONSTANT uint wash_has_background = 1U << 2U;
SHARED_CONSTANT uint wash_is_of_one_variant = 1U << 3U; // paint only the variant `style_variant`
SHARED_CONSTANT uint wash_keeps_cover = 1U << 4U;       // alpha is the coverage of objects

struct WashConstants {
    ToneConstants tone;
    vec3 shadow_tint;    // multiplied into the colour in shadow
    float shadow_from;   // darkness at which shadow begins
    float softness;      // half the width of the step, in darkness
    float ground_shadow; // strength of shadow_tint on blank ground, 0 to 1
    float detail;        // 0: the material's mean colour, 1: its texture
    float least;         // brightness that dark colours are lifted towards
    float strength;      // 0: bare paper, 1: full colour
    float neutral;       // share of the strength for greys
    float saturation;    // 0: greys alone, 1: the materials' colours
    float light_tint;    // how far coloured light tints surfaces
    float air;           // share of air_color at infinite distance
    vec3 air_color;
    float air_distance_m;
    uint style_variant; // style variant to paint
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
