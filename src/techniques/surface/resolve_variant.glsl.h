// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RESOLVE_VARIANT_GLSL_H
#define ESTAMPE_RESOLVE_VARIANT_GLSL_H
// Bits of `variant` of resolve.comp, in addition to texture_class_mask, the classes of sizes that hold
// textures.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint resolve_has_normal_maps = 1U << 5U;
SHARED_CONSTANT uint resolve_has_vertex_colors = 1U << 6U;
SHARED_CONSTANT uint resolve_has_uv_strokes = 1U << 7U;
SHARED_CONSTANT uint resolve_has_second_uvs = 1U << 8U;
// The scene is in its rest pose, so strokes follow the posed position.
SHARED_CONSTANT uint resolve_stands_still = 1U << 9U;
SHARED_CONSTANT uint resolve_has_form_strokes = 1U << 10U;
SHARED_CONSTANT uint resolve_has_page_strokes = 1U << 11U;
SHARED_CONSTANT uint resolve_has_occlusion = 1U << 12U;

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
