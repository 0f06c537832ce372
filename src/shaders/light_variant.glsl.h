// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHT_VARIANT_GLSL_H
#define ESTAMPE_LIGHT_VARIANT_GLSL_H
// Bits of `variant` of light.comp, for light and for the shadow lookups that it includes.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint light_has_shadow = 1U << 0U; // the sun has a shadow map
SHARED_CONSTANT uint light_has_local_lights = 1U << 1U;
SHARED_CONSTANT uint light_has_emissive = 1U << 2U;
SHARED_CONSTANT uint light_has_links = 1U << 3U;
SHARED_CONSTANT uint light_has_lists = 1U << 4U;
// For tests: outputs how many lights were evaluated, and how many of the evaluated lights were within range.
SHARED_CONSTANT uint light_counts_visits = 1U << 5U;
SHARED_CONSTANT uint light_keeps_strongest = 1U << 6U;
SHARED_CONSTANT uint light_looks_at_all = 1U << 7U; // for tests: evaluates every light at every pixel
SHARED_CONSTANT uint light_has_local_shadows = 1U << 8U;
SHARED_CONSTANT uint light_has_lightmap = 1U << 9U;
SHARED_CONSTANT uint light_keeps_sun = 1U << 10U;

// Variants of shadows: edges toothed along strokes or in waves, a sun disc whose shadow map is a clipmap or
// in perspective, and lamps with a radius.
SHARED_CONSTANT uint light_has_stroke_edges = 1U << 11U;
SHARED_CONSTANT uint light_has_wave_edges = 1U << 12U;
SHARED_CONSTANT uint light_has_soft_sun = 1U << 13U;
SHARED_CONSTANT uint light_has_sun_levels = 1U << 14U;
SHARED_CONSTANT uint light_has_sun_warp = 1U << 15U;
SHARED_CONSTANT uint light_has_soft_lamps = 1U << 16U;

// The share of sunlight is read from an image, per pixel.
SHARED_CONSTANT uint light_has_sun_share = 1U << 17U;

// Occlusion darkens the ambient light (this bit), or all light (the next bit).
SHARED_CONSTANT uint light_occludes_ambient = 1U << 18U;
SHARED_CONSTANT uint light_occludes_all = 1U << 19U;
// Occluders reflect light, given as a share of ambient light.
SHARED_CONSTANT uint light_has_bounced = 1U << 20U;

// Positions of the points to light come from an image instead of the depth buffer.
SHARED_CONSTANT uint light_has_points = 1U << 21U;
SHARED_CONSTANT uint light_has_tiles = 1U << 22U; // only tiles in a list are lit

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
