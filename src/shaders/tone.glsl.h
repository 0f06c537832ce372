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

// Coverage in the image of hatching where the area is solid black, if lines are spared in it: more than 1.
SHARED_CONSTANT float solid_ink = 2.0F;

// Parameters of the tone curve, which maps light to darkness on the page.
struct ToneConstants {
    uint curve; // kind of tone curve: tone_linear, tone_gamma or tone_filmic
    float exposure;
    float gamma;
    float contrast;
    float floor;       // darkness below which the paper stays white
    float ceiling;     // largest darkness that is drawn
    float local_value; // degree to which dark materials are drawn darker, 0 to 1
    float occlusion;   // strength of occlusion textures, 0 to 1
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
