// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HALF_PAGE
#define ESTAMPE_HALF_PAGE

// The half page, which has every second pixel in x and y, and depth planes, which tell whether two pixels are
// on one surface. Define before: `frame`, a FrameGlobals, and `constants` with `from_half`.

#include "shaders/camera.glsl"

// Position, in the current tile, of a half-page pixel (the half page has every second pixel of the page).
ivec2 whole_pixel(ivec2 half_pixel)
{
    return min(2 * (half_pixel + ivec2(constants.from_half)) - ivec2(frame.tile_from_px),
               ivec2(frame.size_px) - 1);
}

// A plane that predicts reversed depth around a pixel of a flat surface, where reversed depth is linear over
// the page.
struct DepthPlane {
    float depth;
    vec2 slope;      // change of reversed depth per pixel
    float tolerance; // largest deviation from the plane, in reversed depth
};

DepthPlane depth_plane(ivec2 pixel, float depth, vec3 normal, float tolerance_m)
{
    vec3 point = anchor_at(frame, vec2(pixel) + 0.5, depth);
    vec4 plane = vec4(normal, -dot(normal, point)) * frame.anchor_from_clip;
    // The slope of an edge-on plane is undefined, so the depth is then taken as constant.
    float facing = abs(plane.z) > 1e-12 ? 1.0 / plane.z : 0.0;
    vec4 nearer = frame.clip_from_anchor * vec4(point - frame.view_forward * tolerance_m, 1.0);
    vec4 farther = frame.clip_from_anchor * vec4(point + frame.view_forward * tolerance_m, 1.0);
    float tolerance = nearer.w > 0.0 ? nearer.z / nearer.w - depth : depth;
    return DepthPlane(depth, -2.0 * plane.xy * facing / vec2(frame.page_px),
                      max(max(tolerance, depth - farther.z / farther.w), 1e-12));
}

// Tells whether the depth `depth`, at the offset `offset_px` from a pixel, is on the pixel's depth plane. The
// result is 1 on the plane, and 0 at the plane's `tolerance` or farther from it.
float on_plane(DepthPlane plane, vec2 offset_px, float depth)
{
    float off = abs(depth - plane.depth - dot(plane.slope, offset_px)) / plane.tolerance;
    return depth > 0.0 ? clamp(2.0 - 2.0 * off, 0.0, 1.0) : 0.0;
}

#endif
