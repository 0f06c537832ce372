// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PLANE_STEP
#define ESTAMPE_PLANE_STEP

#include "shaders/camera.glsl"

// Returns the vector from `place` to the point of the same plane that appears `aside_px` pixels away from it
// on the page.
vec3 step_on_plane(FrameGlobals frame, vec2 position_px, float depth, vec3 place, vec3 normal, vec2 aside_px)
{
    vec3 there = anchor_at(frame, position_px + aside_px, depth);
    if (frame.is_orthographic != 0u) {
        vec3 step = there - place;
        return step - frame.view_forward * (dot(normal, step) / dot(normal, frame.view_forward));
    }
    vec3 ray = there - frame.eye_anchor;
    float along = dot(normal, place - frame.eye_anchor) / dot(normal, ray);
    return (along > 0.0 ? along : 1e6) * ray - (place - frame.eye_anchor);
}

#endif
