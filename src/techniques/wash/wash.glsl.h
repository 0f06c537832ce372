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
SHARED_CONSTANT uint wash_has_air = 1U << 0U;    // colours pale with distance
SHARED_CONSTANT uint wash_has_screen = 1U << 1U; // there are see-through surfaces
SHARED_CONSTANT uint wash_has_background = 1U << 2U;
SHARED_CONSTANT uint wash_is_of_one_look = 1U << 3U; // others are painted already
SHARED_CONSTANT uint wash_keeps_cover = 1U << 4U;    // alpha is how much things hide

struct WashConstants {
    ToneConstants tone;
    vec3 shadow_tint;  // multiplied into the colour in shadow
    float shadow_from; // darkness at which shadow begins
    float softness;    // half the width of the step, in darkness
    float detail;      // 0: the material's mean colour, 1: its texture
    float least;       // brightness that dark colours are lifted towards
    float strength;    // 0: bare paper, 1: full colour
    float neutral;     // share of that for greys
    float saturation;  // 0: greys alone, 1: the materials' colours
    float light_tint;  // how far coloured light colours what it falls on
    float air;         // share of the horizon's colour at the far end
    vec3 air_color;
    float air_distance_m;
    uint look; // that is painted
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
