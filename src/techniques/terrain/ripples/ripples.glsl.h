// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RIPPLES_GLSL_H
#define ESTAMPE_RIPPLES_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// A cell of the lattice that ripples hang on, in wavelengths along the wind and across; whole along the wind,
// so that waves go on from cell to cell.
SHARED_CONSTANT float ripple_cell_along = 4.0F;
SHARED_CONSTANT float ripple_cell_across = 7.0F;

struct RippleConstants {
    vec2 wind;  // unit, x and z
    vec2 rest;  // of the anchor in the lattice: along the wind, across
    uvec2 cell; // and the whole cells, as bits of ivec2
    float wavelength_m;
    float height_m; // from trough to crest
    float meander;
    uint draw; // whose surface ripples
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
