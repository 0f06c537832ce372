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
SHARED_CONSTANT uint compose_has_tint = 1U << 0U; // coloured light tints the strokes
SHARED_CONSTANT uint compose_has_sky = 1U << 1U;
SHARED_CONSTANT uint compose_has_margin = 1U << 2U; // the page has a margin or a border
SHARED_CONSTANT uint compose_has_grain = 1U << 3U;  // strokes catch on the paper's tooth
SHARED_CONSTANT uint compose_is_staged = 1U << 4U;  // outputs layers up to a stage, in floats
SHARED_CONSTANT uint compose_has_ink = 1U << 5U;    // the picture has flowing ink
SHARED_CONSTANT uint compose_has_smoke = 1U << 6U;
SHARED_CONSTANT uint compose_develops = 1U << 7U; // writes sRGB bytes directly, for pictures of one sample
SHARED_CONSTANT uint compose_is_transparent = 1U << 8U; // bare paper is transparent
SHARED_CONSTANT uint compose_keeps_things = 1U << 9U;   // paper below objects stays opaque
SHARED_CONSTANT uint compose_has_cover = 1U << 10U;     // the objects' coverage comes from its own image
SHARED_CONSTANT uint develop_has_samples = 1U << 0U;    // the picture has several samples
SHARED_CONSTANT uint develop_is_last = 1U << 1U;        // this is the last sample
SHARED_CONSTANT uint develop_keeps_floats = 1U << 2U;
SHARED_CONSTANT uint develop_is_transparent = 1U << 3U;

// The last layer that is composed.
SHARED_CONSTANT uint stage_paper = 0U;
SHARED_CONSTANT uint stage_wash = 1U;
SHARED_CONSTANT uint stage_ink = 2U;
SHARED_CONSTANT uint stage_hatch = 3U;
SHARED_CONSTANT uint stage_lines = 4U;
SHARED_CONSTANT uint stage_smoke = 5U;
SHARED_CONSTANT uint stage_picture = 6U; // all layers, with the picture's alpha

struct PaperConstants {
    vec3 paper_color;
    float grain; // relief of the paper, 0 to 1
    vec3 ink_color;
    float granulation; // visible relief of the paper, 0 to 1
    float ink_break;   // how far ink skips the high spots
    float ink_tint;    // how far coloured light tints the strokes' ink
    uint seed;
    float ink_grain; // how far strokes get ink only on the paper's tooth
    float border_mm; // width of the line around the window
    vec2 window_min_mm;
    vec2 window_max_mm;
    uint stage;    // for compose_is_staged
    float settles; // how far flowing ink settles in the hollows
};

struct DevelopConstants {
    uint width;
    uint height;
    uint sample_index;
    vec3 paper_color; // for develop_is_transparent
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
