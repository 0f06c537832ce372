// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMOKE_RAY
#define ESTAMPE_SMOKE_RAY

#include "shaders/camera.glsl"

// Of a place of what is drawn, in anchor space: direction of length 1.
struct Ray {
    vec3 origin;
    vec3 direction;
};

Ray ray_at(FrameGlobals frame, vec2 position_px)
{
    if (frame.is_orthographic != 0u) {
        return Ray(anchor_at(frame, position_px, 1.0), frame.view_forward);
    }
    // By a point far off: of one near the eye, what the two places have in common would use up the digits.
    return Ray(frame.eye_anchor, -towards_eye(frame, anchor_at(frame, position_px, 1e-5)));
}

#endif
