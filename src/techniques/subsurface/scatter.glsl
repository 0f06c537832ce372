// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCATTER
#define ESTAMPE_SCATTER

// Length of the view ray inside a body, the half page (every second pixel) on which light spreads, and
// Burley's profile as a mixture of its blur levels. Define before: `frame`, a FrameGlobals, and `constants`,
// ScatterConstants.

#include "shaders/camera.glsl"
#include "techniques/subsurface/profile.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

// Thickness of a body along the view ray. A body without a far side, whose far depth equals its near depth,
// is a sheet.
float thickness_m(vec2 middle_px, float near_side, float far_side, float sheet_m)
{
    vec3 front = anchor_at(frame, middle_px, max(near_side, 1e-9));
    vec3 back = anchor_at(frame, middle_px, max(far_side, 1e-9));
    return far_side == near_side ? sheet_m : distance(front, back);
}

// Variance of the blur that resampling to the half page (every second pixel) and back adds.
const float half_page_variance_px2 = 0.85;

const float nowhere_m = 1e30; // distance that marks pixels whose surface scatters no light

// Kinds of light transport in a pixel; several may apply. The constant `takes_nothing` means that no light is
// transported.
const float takes_nothing = 0.0;
const float takes_light_through = 1.0; // kind of light transport: light arrives from the body's far side
const float takes_light_about = 2.0;   // kind of light transport: light spreads below the surface

// Tiles per side of a square of the page. A square that receives light is listed by the first tile in it.
const uint tiles_a_side = scatter_square_px / 8u;

uvec2 squares_of(uvec2 size_px)
{
    return (size_px + scatter_square_px - 1u) / scatter_square_px;
}

// Position, in the current tile, of a half-page pixel (the half page has every second pixel of the page).
ivec2 whole_pixel(ivec2 half_pixel)
{
    return min(2 * (half_pixel + ivec2(constants.from_half)) - ivec2(frame.tile_from_px),
               ivec2(frame.size_px) - 1);
}

bool is_on_half_page(ivec2 half_pixel)
{
    return all(greaterThanEqual(half_pixel, ivec2(0))) && all(lessThan(uvec2(half_pixel), constants.half_px));
}

// Tile side of the blur's workgroups. A workgroup processes pixels that are as far apart as the blur's taps
// (pixels read). So all taps are in the tile, except for two pixels at each side. Tiles whose pixels
// interleave have consecutive numbers.
const uint blur_tile_side = 16u;

uvec2 blur_groups(uint level)
{
    uint tile_px = blur_tile_side << level;
    return (constants.half_px + tile_px - 1u) / tile_px << level;
}

// Distance of a point from the eye along the view direction.
float ahead_m(vec3 point)
{
    return dot(point - frame.eye_anchor, frame.view_forward);
}

// Distance along the view direction of the visible surface at a place of the page.
float ahead_at(vec2 position_px, float depth, bool in_perspective)
{
    float held = max(depth, 1e-9);
    return in_perspective ? frame.near_m / held : ahead_m(anchor_at(frame, position_px, held));
}

// Size in metres of a page pixel at a distance along the view direction.
float pixel_m_at(float ahead)
{
    return frame.pixel_m * (frame.is_orthographic != 0u ? 1.0 : ahead);
}

// Rounds numbers to half floats, so that shares computed from them in different passes sum to one.
vec3 in_halves(vec3 numbers)
{
    return vec3(unpackHalf2x16(packHalf2x16(numbers.xy)),
                unpackHalf2x16(packHalf2x16(vec2(numbers.z, 0.0))).x);
}

// Scattering distance of each colour of light, in pixels of the page.
vec3 spread_px_of(vec3 scatter_m, float pixel_m)
{
    return in_halves(min(scatter_m / pixel_m, vec3(constants.most_px)));
}

// Standard deviation of a blur level of the half page (every second pixel), in pixels of the page; level -1
// is the unblurred half page.
float deviation_px(int level)
{
    float blurred = 4.0 * (exp2(2.0 * float(level + 1)) - 1.0) / 3.0;
    return sqrt(blurred + half_page_variance_px2);
}

// Standard deviation above which Gaussians of the diffusion profile read the half page (every second pixel).
// Narrower Gaussians use the light on the full page.
float kept_below_px()
{
    return 0.5 * deviation_px(-1);
}

// Standard deviation above which Gaussians of the diffusion profile read the given blur level. Narrower
// Gaussians read the previous level.
float level_from_px(int level)
{
    return sqrt(deviation_px(level - 1) * deviation_px(level));
}

// Factor on the squared distance along the view in the weight of a blur tap (one texel read). The weight is a
// Gaussian with the taps' distance as its deviation. 0 for pixels that scatter no light.
float falloff_at(vec4 own, int apart)
{
    float deviation_m = 2.0 * float(apart) * pixel_m_at(own.w);
    return own.w < nowhere_m ? -0.5 / max(deviation_m * deviation_m, 1e-12) : 0.0;
}

// Change of a pixel's light by another pixel, one or two blur steps away; 0 if one of the two pixels scatters
// no light.
vec3 change_by(vec4 own, vec4 other, int steps, float falloff)
{
    float off = min(abs(other.w - own.w), 1e15);
    float near = falloff < 0.0 ? exp(max(falloff * off * off, -80.0)) : 0.0;
    return (steps == 2 ? 0.0625 : 0.25) * near * (other.rgb - own.rgb);
}

// Multiple of the scattering distance d beyond which less than a thousandth of a pixel's light is left; such
// light is invisible.
const float held_deviations = 9.6;

bool holds_all(float deviation, float spread_px)
{
    return held_deviations * spread_px <= deviation;
}

// Share of a pixel's scattered light in Gaussians with deviations up to `deviation`; 1 if almost nothing is
// left.
vec3 share_up_to(float deviation, vec3 spread_px)
{
    return mix(share_below(deviation, spread_px), vec3(1.0),
               lessThanEqual(held_deviations * spread_px, vec3(deviation)));
}

// Share of a pixel's scattered light that is read from a blur level.
vec3 share_of_level(int level, vec3 spread_px)
{
    vec3 until = constants.is_last != 0u ? vec3(1.0) : share_up_to(level_from_px(level + 1), spread_px);
    return until - share_up_to(level_from_px(level), spread_px);
}

#endif
