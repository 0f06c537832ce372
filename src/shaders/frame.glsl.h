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
    mat4 clip_from_anchor; // jittered; reversed z
    mat4 anchor_from_clip;
    vec3 eye_anchor;
    float pixels_per_mm;
    vec3 view_forward;
    uint is_orthographic;
    uvec2 size_px;
    float near_m;
    float scene_radius_m;
    float nearby_m; // from the eye: nearer is what stands in front
};

#ifdef __cplusplus
static_assert(sizeof(FrameGlobals) == 180);
} // namespace estampe::shared
#endif

#endif
