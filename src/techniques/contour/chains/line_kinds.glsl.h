// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_KINDS_GLSL_H
#define ESTAMPE_LINE_KINDS_GLSL_H
// What lines stand for. Four bits hold a kind.
#ifdef __cplusplus
#include "shaders/shared.hpp"

namespace estampe::shared {
inline constexpr uint line_silhouette = 0U;
inline constexpr uint line_border = 1U;
inline constexpr uint line_boundary = 2U;
inline constexpr uint line_crease = 3U;
inline constexpr uint line_marked = 4U;
inline constexpr uint line_ridge = 5U;
inline constexpr uint line_valley = 6U;
inline constexpr uint line_suggestive = 7U;
inline constexpr uint line_intersection = 8U;
inline constexpr uint line_shadow = 9U;
inline constexpr uint line_kind_count = 10U;
inline constexpr uint line_first_of_page = line_intersection; // this and those after it are found on the page
} // namespace estampe::shared
#else
#define LINE_SILHOUETTE 0u
#define LINE_BORDER 1u
#define LINE_BOUNDARY 2u
#define LINE_CREASE 3u
#define LINE_MARKED 4u
#define LINE_RIDGE 5u
#define LINE_VALLEY 6u
#define LINE_SUGGESTIVE 7u
#define LINE_INTERSECTION 8u
#define LINE_SHADOW 9u
#define LINE_FIRST_OF_PAGE LINE_INTERSECTION // this and those after it are found on the page
#endif

#endif
