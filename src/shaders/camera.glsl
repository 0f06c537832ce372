// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CAMERA
#define ESTAMPE_CAMERA

#include "shaders/frame.glsl.h"
#include "shaders/unit.glsl"

// Position in normalised device coordinates of a point of the page in pixels; y grows downwards in both.
vec2 ndc_at(vec2 position_px, uvec2 size_px)
{
    return 2.0 * position_px / vec2(size_px) - 1.0;
}

// The place on the page of a place of what is drawn, which may be a tile of the page.
vec2 page_place(FrameGlobals frame, vec2 position_px)
{
    return position_px + vec2(frame.tile_from_px);
}

// The point seen at `position_px` with reversed depth `depth` (0 at infinity: pass something above).
vec3 anchor_at(FrameGlobals frame, vec2 position_px, float depth)
{
    vec4 p = frame.anchor_from_clip * vec4(ndc_at(page_place(frame, position_px), frame.page_px), depth, 1.0);
    return p.xyz / p.w;
}

// Unit vector from the surface towards the eye.
vec3 towards_eye(FrameGlobals frame, vec3 point_anchor)
{
    return frame.is_orthographic != 0u ? -frame.view_forward : normalize(frame.eye_anchor - point_anchor);
}

// How much thinner lines are that lie `away_m` from the eye, 0.45 to 1.25: 1 in front.
float thinned_at(FrameGlobals frame, float away_m)
{
    return clamp(pow(frame.nearby_m / max(away_m, 1e-6), 0.4), 0.45, 1.25);
}

// What a pixel spans, in metres, of a plane through the point that faces as the page does.
float pixel_size_m(FrameGlobals frame, vec3 point_anchor)
{
    return frame.pixel_m * (frame.clip_from_anchor * vec4(point_anchor, 1.0)).w;
}

#endif
