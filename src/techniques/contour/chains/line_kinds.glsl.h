// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_KINDS_GLSL_H
#define ESTAMPE_LINE_KINDS_GLSL_H
// What lines stand for. Four bits hold a kind.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint line_silhouette = 0U;
SHARED_CONSTANT uint line_border = 1U;
SHARED_CONSTANT uint line_boundary = 2U;
SHARED_CONSTANT uint line_crease = 3U;
SHARED_CONSTANT uint line_marked = 4U;
SHARED_CONSTANT uint line_ridge = 5U;
SHARED_CONSTANT uint line_valley = 6U;
SHARED_CONSTANT uint line_suggestive = 7U;
SHARED_CONSTANT uint line_crest = 8U;
SHARED_CONSTANT uint line_intersection = 9U;
SHARED_CONSTANT uint line_shadow = 10U;
SHARED_CONSTANT uint line_kind_count = 11U;
SHARED_CONSTANT uint line_first_of_page = line_intersection; // this and those after it are found on the page

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
