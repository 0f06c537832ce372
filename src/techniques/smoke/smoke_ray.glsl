// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_RAY
#define ESTAMPE_SMOKE_RAY

#include "shaders/camera.glsl"

// A ray in anchor space (coordinates relative to a nearby origin); `direction` is a unit vector.
struct Ray {
    vec3 origin;
    vec3 direction;
};

Ray ray_at(FrameGlobals frame, vec2 position_px)
{
    if (frame.is_orthographic != 0u) {
        return Ray(anchor_at(frame, position_px, 1.0), frame.view_forward);
    }
    // The ray's direction is computed from a distant point: near the eye, the difference of two positions
    // would lose its digits to cancellation.
    return Ray(frame.eye_anchor, -towards_eye(frame, anchor_at(frame, position_px, 1e-5)));
}

#endif
