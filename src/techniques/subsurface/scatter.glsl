// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCATTER
#define ESTAMPE_SCATTER

// The half page that light spreads over. Wanted before: `frame`, a FrameGlobals, and `constants`,
// ScatterConstants.

#include "shaders/camera.glsl"

// By how much the way to every second pixel and back blurs, with taps between pixels.
const float half_page_variance_px2 = 1.4;

const float nowhere_m = 1e30; // how far off a pixel is that takes no light in

// Of what is drawn, the pixel that one of the half page stands for.
ivec2 whole_pixel(ivec2 half_pixel)
{
    return min(2 * (half_pixel + ivec2(constants.from_half)) - ivec2(frame.tile_from_px),
               ivec2(frame.size_px) - 1);
}

bool is_on_half_page(ivec2 half_pixel)
{
    return all(greaterThanEqual(half_pixel, ivec2(0))) && all(lessThan(uvec2(half_pixel), constants.half_px));
}

// How far along the view a point lies.
float ahead_m(vec3 point)
{
    return dot(point - frame.eye_anchor, frame.view_forward);
}

// What `scatter_m` is at a point, on the page and then, where that is cut short, in the scene.
vec2 spread_at(float scatter_m, vec3 point)
{
    float pixel_m = pixel_size_m(frame, point);
    float spread_px = min(scatter_m / pixel_m, constants.most_px);
    return vec2(spread_px, spread_px * pixel_m);
}

#endif
