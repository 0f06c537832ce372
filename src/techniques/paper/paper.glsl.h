// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAPER_GLSL_H
#define ESTAMPE_PAPER_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Bits of `variant` of compose.comp and develop.comp.
SHARED_CONSTANT uint compose_has_tint = 1U << 0U; // coloured light tints the strokes
SHARED_CONSTANT uint compose_has_sky = 1U << 1U;
SHARED_CONSTANT uint compose_has_margin = 1U << 2U; // the page has a margin or a border
// Dry strokes leave ink only on the high spots of the paper.
SHARED_CONSTANT uint compose_has_grain = 1U << 3U;
SHARED_CONSTANT uint compose_is_staged = 1U << 4U; // the pass writes the layers up to a stage, in floats
SHARED_CONSTANT uint compose_has_ink = 1U << 5U;   // the picture has flowing ink
SHARED_CONSTANT uint compose_has_smoke = 1U << 6U;
// The pass writes sRGB bytes directly, for pictures of one sample.
SHARED_CONSTANT uint compose_develops = 1U << 7U;
SHARED_CONSTANT uint compose_is_transparent = 1U << 8U; // bare paper is transparent
SHARED_CONSTANT uint compose_keeps_things = 1U << 9U;   // paper under objects stays opaque
SHARED_CONSTANT uint compose_has_cover = 1U << 10U;     // the coverage by objects comes from its own image
SHARED_CONSTANT uint compose_is_shifted = 1U << 11U;    // paint is printed beside its place
SHARED_CONSTANT uint develop_has_samples = 1U << 0U;    // the picture has several samples
SHARED_CONSTANT uint develop_is_last = 1U << 1U;        // set in the pass of the picture's last sample
SHARED_CONSTANT uint develop_keeps_floats = 1U << 2U;
SHARED_CONSTANT uint develop_is_transparent = 1U << 3U;

// Constants for the last layer that is composed.
SHARED_CONSTANT uint stage_paper = 0U;
SHARED_CONSTANT uint stage_wash = 1U;
SHARED_CONSTANT uint stage_ink = 2U;
SHARED_CONSTANT uint stage_hatch = 3U;
SHARED_CONSTANT uint stage_lines = 4U;
SHARED_CONSTANT uint stage_smoke = 5U;
SHARED_CONSTANT uint stage_picture = 6U; // all layers, with the picture's alpha

struct PaperConstants {
    vec3 paper_color;
    float grain; // visibility of the bare paper's relief, 0 to 1
    vec3 ink_color;
    float granulation; // visibility of the paper's relief in paint, 0 to 1
    float ink_break;   // degree to which ink skips the paper's high spots
    float ink_tint;    // degree to which coloured light tints the strokes' ink
    uint seed;
    float ink_grain; // degree to which strokes get ink only on the paper's high spots
    float border_mm; // width of the border line around the window
    vec2 window_min_mm;
    vec2 window_max_mm;
    uint stage;           // last layer to compose, for compose_is_staged
    float overprint;      // degree to which paint shows through the ink of strokes and lines
    ivec2 paint_shift_px; // how far paint is printed to the right of its place, and below
    float settles;        // degree to which flowing ink settles in the paper's hollows
};

struct DevelopConstants {
    uint width;
    uint height;
    uint sample_index;
    vec3 paper_color; // colour of transparent paper, for develop_is_transparent
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
