// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_GROUPS
#define ESTAMPE_GROUPS

// The table of areas of one tone, and the tone of a pixel before areas are joined. Requires `constants`.
// An area is named by the smallest number of its pixels.

#include "techniques/hatch/hatch.glsl.h"

layout(binding = 0) uniform sampler2D darkness_image; // smoothed

// For each pixel, a pixel of the same area with a smaller number, or the pixel itself. Threads may read a
// value that another thread has replaced meanwhile: the old value is a pixel of the same area, too.
layout(scalar, binding = 1) buffer Parents
{
    uint parents[];
};

// Number of pixels of each area, at the area's name; large areas are not counted to the end. Entries of other
// pixels are not used.
layout(scalar, binding = 2) buffer Sizes
{
    uint pixels_of[];
};

// Only for small areas: length of the border with areas that are not small. There is a layer for each tone
// beyond the border, and an area's texel is the pixel that names it. This is an image and not a buffer,
// because a device binds less of a buffer than a page of A4 needs.
layout(r32ui, binding = 3) uniform uimage2DArray borders;

const uint no_group = 0xffffffffu;
// Areas keep their own tone in full from this multiple of the least area on, so that a growing area appears
// little by little.
const float full_area = 1.5;

uint number_of(ivec2 pixel)
{
    return uint(pixel.y) * constants.size_px.x + uint(pixel.x);
}

ivec3 border_texel(uint name, uint tone)
{
    return ivec3(name % constants.size_px.x, name / constants.size_px.x, tone);
}

// Tone of a pixel, counted from 0 for paper; no_group beyond the page and where nothing is hatched.
uint group_at(ivec2 pixel)
{
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return no_group;
    }
    float dark = texelFetch(darkness_image, pixel, 0).x;
    return dark < 0.0 ? no_group : group_of(dark, constants.count);
}

#endif
