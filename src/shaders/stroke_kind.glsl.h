// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_KIND_GLSL_H
#define ESTAMPE_STROKE_KIND_GLSL_H
// What the strokes of a surface follow: three bits of the draw word. All but uv, form and page are slices
// through the rest pose and differ in the planes that slice.
#ifdef __cplusplus
#include "shaders/shared.hpp"

namespace estampe::shared {
inline constexpr uint strokes_solid = 0U;
inline constexpr uint strokes_uv = 1U;
inline constexpr uint strokes_form = 2U;
inline constexpr uint strokes_height = 3U;
inline constexpr uint strokes_wind = 4U;
inline constexpr uint strokes_light = 5U;
inline constexpr uint strokes_page = 6U;
inline constexpr uint strokes_automatic = 7U; // uv where they can carry strokes, else solid
} // namespace estampe::shared
#else
#define STROKES_SOLID 0u
#define STROKES_UV 1u
#define STROKES_FORM 2u
#define STROKES_HEIGHT 3u
#define STROKES_WIND 4u
#define STROKES_LIGHT 5u
#define STROKES_PAGE 6u
#define STROKES_AUTOMATIC 7u
#endif

#endif
