// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TONE
#define ESTAMPE_TONE

#include "shaders/tone.glsl.h"

// Light that remains on a surface if the material's occlusion texture lets the share `open` through.
float occluded(ToneConstants tone, float light, float open)
{
    return light * mix(1.0f, open, tone.occlusion);
}

// Tone curve: maps light to a share of white. The filmic curve is linear up to 0.6, and approaches white
// without reaching it.
float toned(ToneConstants tone, float value)
{
    float shoulder = 0.6f + 0.4f * (1.0f - exp(-max(value - 0.6f, 0.0f) / 0.4f));
    float bent = tone.curve == tone_filmic && value > 0.6f ? shoulder : clamp(value, 0.0f, 1.0f);
    return tone.curve == tone_linear ? bent : pow(bent, tone.gamma);
}

// Darkness to draw, 0 (paper) to 1 (ink), for a surface with brightness `local_value` in the light `light`.
// Contrast is a factor about the middle tone, and the result is clamped (Zanuttini, "Recherches en rendu non
// réaliste temps réel", Université Paris 8, 2008, annex 1). Below the floor the paper stays white.
float darkness(ToneConstants tone, float light, float local_value)
{
    float value = light * tone.exposure * mix(1.0f, local_value, tone.local_value);
    float dark = 1.0f - toned(tone, value);
    dark = clamp((dark - 0.5f) * tone.contrast + 0.5f, 0.0f, 1.0f);
    return clamp((dark - tone.floor) / (tone.ceiling - tone.floor), 0.0f, 1.0f) * tone.ceiling;
}

#endif
