// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HAZE
#define ESTAMPE_HAZE

// Fading of a drawing with distance. Requires before inclusion: `frame`, `constants` (haze.glsl.h), and
// HAZE_DEPTH_BINDING.

#include "shaders/camera.glsl"

layout(binding = HAZE_DEPTH_BINDING) uniform sampler2D depth_image;

const int line_steps = 4; // most samples per direction in the search for the surface of a line

float haze_depth(ivec2 pixel)
{
    return texelFetch(depth_image, clamp(pixel, ivec2(0), ivec2(frame.size_px) - 1), 0).x;
}

// Number of times that haze halves the contrast of a point at a pixel and depth.
float halvings(ivec2 pixel, float depth)
{
    vec3 from_eye = anchor_at(frame, vec2(pixel) + 0.5, max(depth, 1e-9)) - frame.eye_anchor;
    float away = frame.is_orthographic != 0u ? dot(from_eye, frame.view_forward) : length(from_eye);
    return max(away - constants.start_m, 0.0) * constants.halves_per_m;
}

float ink_left(ivec2 pixel, float depth)
{
    return exp2(-constants.ink * halvings(pixel, depth));
}

const ivec2 eight_ways[8] = ivec2[8](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(1, 1),
                                     ivec2(-1, 1), ivec2(-1, -1), ivec2(1, -1));

// Depth of the surface to which a line at a pixel belongs. Half of a line's width is outside the edge that
// the line follows, over a farther surface or the background. To find the depth of the line's surface, each
// sample extrapolates the depth of neighbours to the line's pixel, because reversed depth is linear over a
// plane in page coordinates. The extrapolation gives the depth on the plane at the pixel, or the depth of a
// nearer surface that ends between sample and pixel. Negative if no surface is near.
float line_depth(ivec2 pixel, float own)
{
    float nearest = own > 0.0 ? own : -1.0;
    int reach = int(constants.line_reach_px);
    int steps = min(reach, line_steps);
    for (int i = 0; i < 8 * steps; ++i) {
        ivec2 aside = eight_ways[i & 7] * ((reach * (1 + i / 8) + steps - 1) / steps);
        float there = haze_depth(pixel + aside);
        if (there > 0.0) {
            nearest = max(nearest, clamp(2.0 * there - haze_depth(pixel + 2 * aside), 0.0, there));
        }
    }
    return nearest;
}

#endif
