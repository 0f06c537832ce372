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

// Parameters that map light to darkness on the page.
struct ToneConstants {
    uint curve; // tone_gamma, tone_linear or tone_filmic
    float exposure;
    float gamma;
    float contrast;
    float floor;       // darkness below this stays paper
    float ceiling;     // Upper limit of darkness
    float local_value; // How much darker dark materials are drawn, 0 to 1
    float occlusion;   // Strength of the occlusion texture, 0 to 1
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
