// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMUDGE_GLSL_H
#define ESTAMPE_SMUDGE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Cells of ink are squares of `cell_px` pixels that lie at fixed places of the page, so that the tiles of a
// page fit together.
struct SmudgeGatherConstants {
    uvec2 size_px; // size of the page, or of the current tile of the page
    uvec2 from_px; // position of the tile on the page
    uvec2 cell_count;
    uint cell_px;
};

struct SmudgeSpreadConstants {
    uvec2 cell_count;
    uvec2 axis;    // (1, 0) spreads horizontally, (0, 1) vertically
    uint radius;   // radius of the blur on each side, in cells
    float falloff; // exponent of the blur: 1 / (2 sigma^2), sigma: the blur's standard deviation in cells
};

struct SmudgeConstants {
    uvec2 size_px;
    uvec2 from_px;
    vec3 ink; // linear colour of the rubbed pigment
    float strength;
    uint cell_px;
    uint radius_px; // radius of the blur of edges on each side
    float falloff;  // exponent of that blur: 1 / (2 sigma^2), sigma in pixels
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
