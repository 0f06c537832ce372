// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_KIND_GLSL_H
#define ESTAMPE_STROKE_KIND_GLSL_H
// What the strokes of a surface follow: three bits of the draw word. All but uv, form and page are slices
// through the rest pose and differ in the planes that slice.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint strokes_solid = 0U;
SHARED_CONSTANT uint strokes_uv = 1U;
SHARED_CONSTANT uint strokes_form = 2U;
SHARED_CONSTANT uint strokes_height = 3U;
SHARED_CONSTANT uint strokes_wind = 4U;
SHARED_CONSTANT uint strokes_light = 5U;
SHARED_CONSTANT uint strokes_page = 6U;
SHARED_CONSTANT uint strokes_slope = 7U; // along the ripples of the ground, bent by its slopes
SHARED_CONSTANT uint strokes_automatic =
    8U; // in no word: the ground's slope, uv where they can carry strokes, else solid

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
