// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TONE
#define ESTAMPE_TONE

#include "shaders/tone.glsl.h"

// Light that is left where the share `open` of it gets through, by the material's occlusion texture.
float occluded(ToneConstants tone, float light, float open)
{
    return light * mix(1.0f, open, tone.occlusion);
}

// Light as a share of white. The filmic curve is straight up to 0.6, then bends so that it reaches white
// nowhere.
float toned(ToneConstants tone, float value)
{
    float shoulder = 0.6f + 0.4f * (1.0f - exp(-max(value - 0.6f, 0.0f) / 0.4f));
    float bent = tone.curve == tone_filmic && value > 0.6f ? shoulder : clamp(value, 0.0f, 1.0f);
    return tone.curve == tone_linear ? bent : pow(bent, tone.gamma);
}

// Darkness to be drawn, 0 (paper) to 1 (ink), of a surface that is lit with `light` and has brightness
// `local_value`. The contrast multiplies about the middle and saturates (Zanuttini, "Recherches en rendu non
// réaliste temps réel", Université Paris 8, 2008, annex 1). Below the floor the paper stays white.
float darkness(ToneConstants tone, float light, float local_value)
{
    float value = light * tone.exposure * mix(1.0f, local_value, tone.local_value);
    float dark = 1.0f - toned(tone, value);
    dark = clamp((dark - 0.5f) * tone.contrast + 0.5f, 0.0f, 1.0f);
    return clamp((dark - tone.floor) / (tone.ceiling - tone.floor), 0.0f, 1.0f) * tone.ceiling;
}

#endif
