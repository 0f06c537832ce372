// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCATTER
#define ESTAMPE_SCATTER

// How far the eye's ray runs within what it enters, the half page that light spreads over, and Burley's
// profile as a mixture of the blurs of it. Wanted before: `frame`, a FrameGlobals, and `constants`,
// ScatterConstants.

#include "shaders/camera.glsl"
#include "techniques/subsurface/profile.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

// What has no far side, whose depth is its own then, is a sheet.
float thickness_m(vec2 middle_px, float near_side, float far_side, float sheet_m)
{
    vec3 front = anchor_at(frame, middle_px, max(near_side, 1e-9));
    vec3 back = anchor_at(frame, middle_px, max(far_side, 1e-9));
    return far_side == near_side ? sheet_m : distance(front, back);
}

// By how much the way to every second pixel and back blurs.
const float half_page_variance_px2 = 0.85;

const float nowhere_m = 1e30; // how far off a pixel is that takes no light in

// What becomes of light in a pixel; both may hold.
const float takes_nothing = 0.0;
const float takes_light_through = 1.0; // it comes from the far side
const float takes_light_about = 2.0;   // it spreads

// What gets any light is listed by squares of the page, by the first of the tiles that each one has.
const uint tiles_a_side = scatter_square_px / 8u;

uvec2 squares_of(uvec2 size_px)
{
    return (size_px + scatter_square_px - 1u) / scatter_square_px;
}

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

// A blur works on tiles of pixels that lie as far apart as its taps do, so that what a tile looks at lies in
// it, but for two at each side: how many groups that takes. Tiles of pixels beside each other come one after
// another.
const uint blur_tile_side = 16u;

uvec2 blur_groups(uint level)
{
    uint tile_px = blur_tile_side << level;
    return (constants.half_px + tile_px - 1u) / tile_px << level;
}

// How far along the view a point lies.
float ahead_m(vec3 point)
{
    return dot(point - frame.eye_anchor, frame.view_forward);
}

// The same of what is seen at a place of the page.
float ahead_at(vec2 position_px, float depth, bool in_perspective)
{
    float held = max(depth, 1e-9);
    return in_perspective ? frame.near_m / held : ahead_m(anchor_at(frame, position_px, held));
}

// What a pixel of the page spans so far along the view.
float pixel_m_at(float ahead)
{
    return frame.pixel_m * (frame.is_orthographic != 0u ? 1.0 : ahead);
}

// Numbers as half floats hold them, so that shares of them add up to one wherever they are worked out.
vec3 in_halves(vec3 numbers)
{
    return vec3(unpackHalf2x16(packHalf2x16(numbers.xy)),
                unpackHalf2x16(packHalf2x16(vec2(numbers.z, 0.0))).x);
}

// How far light spreads on the page, by colour.
vec3 spread_px_of(vec3 scatter_m, float pixel_m)
{
    return in_halves(min(scatter_m / pixel_m, vec3(constants.most_px)));
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

// By what squares of ways along the view count less for a pixel, in a blur whose taps are so far apart: its
// deviation in the scene is as wide as they are. Nothing counts for what takes no light in.
float falloff_at(vec4 own, int apart)
{
    float deviation_m = 2.0 * float(apart) * pixel_m_at(own.w);
    return own.w < nowhere_m ? -0.5 / max(deviation_m * deviation_m, 1e-12) : 0.0;
}

// By how much the light of a pixel changes by another, one or two steps off. Where one of the two takes none
// in it does not.
vec3 change_by(vec4 own, vec4 other, int steps, float falloff)
{
    float off = min(abs(other.w - own.w), 1e15);
    float near = falloff < 0.0 ? exp(max(falloff * off * off, -80.0)) : 0.0;
    return (steps == 2 ? 0.0625 : 0.25) * near * (other.rgb - own.rgb);
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

// The share of a pixel's light that is taken of a blur.
vec3 share_of_level(int level, vec3 spread_px)
{
    vec3 until = constants.is_last != 0u ? vec3(1.0) : share_up_to(level_from_px(level + 1), spread_px);
    return until - share_up_to(level_from_px(level), spread_px);
}

#endif
