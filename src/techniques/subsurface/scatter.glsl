// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCATTER
#define ESTAMPE_SCATTER

// The half page that light spreads over, and Burley's profile as a mixture of the blurs of it. Wanted before:
// `frame`, a FrameGlobals, and `constants`, ScatterConstants.

#include "shaders/camera.glsl"
#include "techniques/subsurface/profile.glsl"

// By how much the way to every second pixel and back blurs.
const float half_page_variance_px2 = 0.85;

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

// The standard deviation of the half page blurred up to a level, in pixels of the page; of the half page
// itself at -1.
float deviation_px(int level)
{
    float blurred = 4.0 * (exp2(2.0 * float(level + 1)) - 1.0) / 3.0;
    return sqrt(blurred + half_page_variance_px2);
}

// From which deviation on they are taken for the half page, rather than for the light as it lies there.
float kept_below_px()
{
    return 0.5 * deviation_px(-1);
}

// From which deviation on they are taken for a level, rather than for the one before it.
float level_from_px(int level)
{
    return sqrt(deviation_px(level - 1) * deviation_px(level));
}

// Of a pixel's light a thousandth has deviations beyond so many times d: nobody can tell.
const float held_deviations = 9.6;

bool holds_all(float deviation, float spread_px)
{
    return held_deviations * spread_px <= deviation;
}

// The share of a pixel's light whose deviations are at most so large: all of it, where next to nothing is
// left.
vec3 share_up_to(float deviation, vec3 spread_px)
{
    return mix(share_below(deviation, spread_px), vec3(1.0),
               lessThanEqual(held_deviations * spread_px, vec3(deviation)));
}

#endif
