// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_THICKNESS
#define ESTAMPE_THICKNESS

// How far the eye's ray runs within what it enters. Wanted before: `frame`, a FrameGlobals.

#include "shaders/camera.glsl"

// What has no far side, whose depth is its own then, is a sheet.
float thickness_m(vec2 middle_px, float near_side, float far_side, float sheet_m)
{
    vec3 front = anchor_at(frame, middle_px, max(near_side, 1e-9));
    vec3 back = anchor_at(frame, middle_px, max(far_side, 1e-9));
    return far_side == near_side ? sheet_m : distance(front, back);
}

#endif
