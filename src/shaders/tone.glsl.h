// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TONE_GLSL_H
#define ESTAMPE_TONE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint tone_gamma = 0U;
SHARED_CONSTANT uint tone_linear = 1U;
SHARED_CONSTANT uint tone_filmic = 2U;

// How light becomes darkness on the page.
struct ToneConstants {
    uint curve; // tone_gamma, tone_linear or tone_filmic
    float exposure;
    float gamma;
    float contrast;
    float floor;       // darkness under it stays paper
    float ceiling;     // darkness over it is no darker
    float local_value; // how much a dark material is drawn darker, 0 to 1
    float occlusion;   // how much of the light is kept off occluded places, 0 to 1
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
