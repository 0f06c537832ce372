// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAPER_GLSL_H
#define ESTAMPE_PAPER_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bits of compose.comp and develop.comp.
SHARED_CONSTANT uint compose_has_tint = 1U << 0U; // coloured light colours the strokes
SHARED_CONSTANT uint compose_has_sky = 1U << 1U;
SHARED_CONSTANT uint compose_has_margin = 1U << 2U; // or a border
SHARED_CONSTANT uint compose_has_grain = 1U << 3U;  // strokes catch on the tooth
SHARED_CONSTANT uint compose_is_staged = 1U << 4U;  // layers up to one of them, in floats
SHARED_CONSTANT uint compose_has_ink = 1U << 5U;    // that flows
SHARED_CONSTANT uint compose_has_smoke = 1U << 6U;
SHARED_CONSTANT uint compose_develops = 1U << 7U;       // the one sample of a picture
SHARED_CONSTANT uint compose_is_transparent = 1U << 8U; // bare paper is
SHARED_CONSTANT uint compose_keeps_things = 1U << 9U;   // but not the paper that things are painted on
SHARED_CONSTANT uint compose_has_cover = 1U << 10U;     // which an image of its own says
SHARED_CONSTANT uint develop_has_samples = 1U << 0U;    // several of them
SHARED_CONSTANT uint develop_is_last = 1U << 1U;        // of them
SHARED_CONSTANT uint develop_keeps_floats = 1U << 2U;
SHARED_CONSTANT uint develop_is_transparent = 1U << 3U;

// How far the layers are laid.
SHARED_CONSTANT uint stage_paper = 0U;
SHARED_CONSTANT uint stage_wash = 1U;
SHARED_CONSTANT uint stage_ink = 2U;
SHARED_CONSTANT uint stage_hatch = 3U;
SHARED_CONSTANT uint stage_lines = 4U;
SHARED_CONSTANT uint stage_smoke = 5U;
SHARED_CONSTANT uint stage_picture = 6U; // all layers, and the alpha of the picture

struct PaperConstants {
    vec3 paper_color;
    float grain; // relief of the paper, 0 to 1
    vec3 ink_color;
    float granulation; // how far paint settles in the hollows
    float ink_break;   // how far ink skips the heights
    float ink_tint;    // how far coloured light colours the strokes' ink
    uint seed;
    float ink_grain; // how far strokes catch on the tooth alone
    float border_mm; // width of the line around the window
    vec2 window_min_mm;
    vec2 window_max_mm;
    uint stage;    // of the variant that is staged
    float settles; // how far ink that flows settles in the hollows
};

struct DevelopConstants {
    uint width;
    uint height;
    uint sample_index;
    vec3 paper_color; // of the variant that is transparent
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
