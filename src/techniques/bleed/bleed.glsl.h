// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_BLEED_GLSL_H
#define ESTAMPE_BLEED_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bit of bleed_across.comp: only the ink of lines runs, not that of strokes.
SHARED_CONSTANT uint bleed_only_lines = 1U << 0U;

struct BleedConstants {
    uvec2 size_px;
    uint radius_px; // radius of the blur on each side
    float falloff;  // exponent of the blur: 1 / (2 sigma^2), sigma: the blur's standard deviation in px
    float level;    // amount of blurred ink at which paper turns to ink
    float reach;    // weight of the ink that has bled, 0 to 1
    float contrast; // contrast of the blurred ink around the coverage `level`
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
