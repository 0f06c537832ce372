// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_KIND_GLSL_H
#define ESTAMPE_STROKE_KIND_GLSL_H
// The direction that a surface's strokes follow: three bits of the pixel's word in the draw image, which also
// holds the draw call. The kinds of strokes other than uv, form and page slice the rest pose by planes. These
// kinds differ in the planes.
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
SHARED_CONSTANT uint strokes_slope = 7U; // strokes along the ripples of the terrain, bent by its slopes
SHARED_CONSTANT uint strokes_automatic =
    8U; // never in the draw image; stands for slope on terrain, for uv where UVs are suitable, else for solid

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
