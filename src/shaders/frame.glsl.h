// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FRAME_GLSL_H
#define ESTAMPE_FRAME_GLSL_H
// What every pass of a frame may need to know of camera and page. Space "anchor" is world space, translated
// to a point near the scene so that floats suffice.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct FrameGlobals {
    mat4 clip_from_anchor; // of the whole page; jittered; reversed z
    mat4 anchor_from_clip;
    vec3 eye_anchor;
    float pixels_per_mm;
    vec3 view_forward;
    uint is_orthographic;
    uvec2 size_px; // of what is drawn: the page, or a tile of it
    float near_m;
    float scene_radius_m;
    float nearby_m;     // from the eye: nearer is what stands in front
    float pixel_m;      // what a pixel spans at a distance of one; in parallel projection at any
    uvec2 page_px;      // the whole page
    uvec2 tile_from_px; // where on it the first pixel of what is drawn lies
};

#ifdef __cplusplus
static_assert(sizeof(FrameGlobals) == 200);
} // namespace estampe::shared
#endif

#endif
