// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FRAME_GLSL_H
#define ESTAMPE_FRAME_GLSL_H
// Camera and page data for all passes of a frame. Anchor space is world space moved so that its origin is
// near the scene; floats are then precise enough.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct FrameGlobals {
    mat4 clip_from_anchor; // projection of the whole page, with jitter and reversed z
    mat4 anchor_from_clip;
    vec3 eye_anchor;
    float pixels_per_mm;
    vec3 view_forward;
    uint is_orthographic;
    uvec2 size_px; // size in pixels of the rendered area: the page, or a tile of it
    float near_m;
    float scene_radius_m;
    float nearby_m;     // distance from the eye to the foreground
    float pixel_m;      // size of a pixel at distance 1 from the eye; in parallel projection at any distance
    uvec2 page_px;      // size of the whole page in pixels
    uvec2 tile_from_px; // page position of the rendered area's first pixel
};

#ifdef __cplusplus
static_assert(sizeof(FrameGlobals) == 200);
} // namespace estampe::shared
#endif

#endif
