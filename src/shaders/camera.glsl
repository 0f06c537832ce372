// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CAMERA
#define ESTAMPE_CAMERA

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"

// Normalised device coordinates of a page position in pixels. The y axis points down in normalised device
// coordinates and on the page.
vec2 ndc_at(vec2 position_px, uvec2 size_px)
{
    return 2.0 * position_px / vec2(size_px) - 1.0;
}

// Page position of a pixel position in the rendered area, which may be a tile of the page.
vec2 page_place(FrameGlobals frame, vec2 position_px)
{
    return position_px + vec2(frame.tile_from_px);
}

// The point that is seen at `position_px` with reversed depth `depth`, in anchor space (relative to an origin
// near the camera). At infinity depth is 0; pass a small positive value instead.
vec3 anchor_at(FrameGlobals frame, vec2 position_px, float depth)
{
    vec4 p = frame.anchor_from_clip * vec4(ndc_at(page_place(frame, position_px), frame.page_px), depth, 1.0);
    return p.xyz / p.w;
}

// Unit vector from a surface point to the eye.
vec3 towards_eye(FrameGlobals frame, vec3 point_anchor)
{
    return frame.is_orthographic != 0u ? -frame.view_forward : normalize(frame.eye_anchor - point_anchor);
}

// Factor on the width of lines at the distance `away_m` from the eye: 0.45 to 1.25, and 1 in the foreground.
float thinned_at(FrameGlobals frame, float away_m)
{
    return clamp(pow(frame.nearby_m / max(away_m, 1e-6), 0.4), 0.45, 1.25);
}

// Size in metres of a page pixel at a point's distance, on a plane parallel to the page.
float pixel_size_m(FrameGlobals frame, vec3 point_anchor)
{
    return frame.pixel_m * (frame.clip_from_anchor * vec4(point_anchor, 1.0)).w;
}

#endif
