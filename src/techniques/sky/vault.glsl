// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VAULT
#define ESTAMPE_VAULT

// Coordinates and pen of the strokes that hatch the sky. The including shader must define `frame` before it
// includes vault.glsl.

#include "shaders/camera.glsl"
#include "shaders/lines.glsl"

// View direction at a position of the page. The direction is computed from a distant point, because near the
// eye the difference of two positions would lose its digits to cancellation.
vec3 direction_at(vec2 position_px)
{
    return -towards_eye(frame, anchor_at(frame, position_px, 1e-5));
}

// Whether the visible surface in direction `d` is nearer to the eye than `far_m`, so that it hides the sky.
bool is_covered(sampler2D depth_image, ivec2 pixel, vec3 d, float far_m)
{
    float depth_at_most = frame.near_m / max(0.999 * far_m * dot(d, frame.view_forward), 1e-9);
    return frame.is_orthographic == 0u && texelFetch(depth_image, pixel, 0).x > depth_at_most;
}

// Coordinates on the sky: the bearing, and the height above the horizon. The height is distorted, so that
// strokes of equal height curve on the page like a vault.
vec2 vault(vec3 d)
{
    return vec2(atan(d.x, -d.z), d.y / (0.35 + length(d.xz)));
}

// Coordinate along the sky's strokes: the bearing. A bearing must jump by a full turn somewhere, and each
// stroke is interrupted at the jump. The jump is behind the viewer, at a bearing that differs from stroke to
// stroke.
float along_strokes(vec2 here)
{
    float middle = 1.2 * sin(53.0 * here.y);
    return here.x + 6.2831853 * round((middle - here.x) / 6.2831853);
}

// Horizontal strokes in the direction `d`. `position_px` is the pixel position that looks in the direction
// `d`.
LineField level_strokes(vec3 d, vec2 position_px)
{
    vec2 here = vault(d);
    vec2 right = vault(direction_at(position_px + vec2(1.0, 0.0))) - here;
    vec2 down = vault(direction_at(position_px + vec2(0.0, 1.0))) - here;
    right.x -= 6.2831853 * round(right.x / 6.2831853);
    down.x -= 6.2831853 * round(down.x / 6.2831853);
    vec2 gradient = vec2(right.y, down.y);
    LineField field;
    field.v = here.y;
    field.v_per_px = length(gradient);
    vec2 along = vec2(-gradient.y, gradient.x) / max(field.v_per_px, 1e-12);
    field.u = along_strokes(here);
    field.u_per_px = abs(right.x * along.x + down.x * along.y);
    field.wander = vec2(field.u, here.y);
    field.wraps = false;
    return field;
}

// The pen that draws the horizontal strokes of the sky.
HatchLineStyle level_pen(float pen_px)
{
    return HatchLineStyle(pen_px, 0.9 * pen_px, 26.0 * pen_px, 40.0 * pen_px, 190.0 * pen_px, 0.35, 0.0);
}

#endif
