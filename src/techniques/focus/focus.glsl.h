// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FOCUS_GLSL_H
#define ESTAMPE_FOCUS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

// A focus line: a wedge that points at the middle. The middle is surrounded by equal sectors, one per line.
// The sectors are counted from +x towards +y, which points down the page.
struct FocusLine {
    vec2 outwards; // direction of the line on the page, away from the middle
    float tip_px;  // distance of the line's tip from the middle
    float end_px;
    float half_width_px; // half the line's width at the distance end_px
};

struct FocusConstants {
    uvec2 size_px;
    vec2 middle_px;
    uint line_count;
    vec3 ink;
};

#ifdef __cplusplus
static_assert(sizeof(FocusLine) == 20);
} // namespace estampe::shared
#endif

#endif
