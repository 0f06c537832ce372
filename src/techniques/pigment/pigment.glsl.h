// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PIGMENT_GLSL_H
#define ESTAMPE_PIGMENT_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Variant bit of pigment_gather.comp: gathers the optical density of paint, not the ink of strokes.
SHARED_CONSTANT uint pigment_gathers_paint = 1U << 0U;

// Largest optical density of paint, which lets the share exp(-7) of the light through.
SHARED_CONSTANT float pigment_densest = 7.0F;

// Cells are squares of `cell_px` pixels that lie at fixed places of the page, so that the tiles of a page fit
// together.
struct PigmentGatherConstants {
    uvec2 size_px; // size of the page, or of the current tile of the page
    uvec2 from_px; // position of the tile on the page
    uvec2 cell_count;
    uint cell_px;
};

struct PigmentSpreadConstants {
    uvec2 cell_count;
    uvec2 axis;    // (1, 0) spreads horizontally, (0, 1) vertically
    uint radius;   // radius of the blur on each side, in cells
    float falloff; // exponent of the blur: 1 / (2 sigma^2), sigma: the blur's standard deviation in cells
};

// For pigment_soften.comp and pigment_rub.comp.
struct PigmentDryConstants {
    uvec2 size_px;
    uvec2 from_px;
    vec3 ink; // linear colour of the rubbed pigment
    float rub;
    uint cell_px;
    uint radius_px; // radius of the blur of edges on each side
    float falloff;  // exponent of that blur: 1 / (2 sigma^2), sigma in pixels
};

// For pigment_pool.comp.
struct PigmentWetConstants {
    uvec2 size_px;
    uvec2 from_px;
    float pixels_per_mm;
    float stray_mm;
    float pool;
    float wet;
    uint cell_px;
    uint seed;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
