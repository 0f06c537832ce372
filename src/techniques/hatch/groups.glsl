// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_GROUPS
#define ESTAMPE_GROUPS

// The table of areas of one tone, and the tone of a pixel before areas are joined. Requires `constants`.
// An area is named by the first of its pixels.

#include "techniques/hatch/hatch.glsl.h"

layout(binding = 0) uniform sampler2D darkness_image; // smoothed

// For each pixel, the name of a pixel of the same area that is earlier, or of the pixel itself. Threads may
// read a value that another thread has replaced meanwhile: the old value is a pixel of the same area, too.
layout(r32ui, binding = 1) uniform uimage2D parents;

// What is known of an area, at the pixel that names it; values at other pixels are not used. The layers are:
// the number of pixels, which for large areas is not counted to the end; then, for small areas and each tone
// beyond, the length of the border with areas that are not small. Images, because a device binds much less of
// a buffer than a large page needs.
layout(r32ui, binding = 2) uniform uimage2DArray areas;

const uint no_group = 0xffffffffu;
// Areas keep their own tone in full from this multiple of the least area on, so that a growing area appears
// little by little.
const float full_area = 1.5;

// Pixels are named in the order of rows, and by columns within a row.
uint name_at(ivec2 pixel)
{
    return uint(pixel.y) << 16u | uint(pixel.x);
}

ivec2 pixel_of(uint name)
{
    return ivec2(name & 0xffffu, name >> 16u);
}

uint parent_of(uint name)
{
    return imageLoad(parents, pixel_of(name)).x;
}

uint pixels_of(uint name)
{
    return imageLoad(areas, ivec3(pixel_of(name), 0)).x;
}

ivec3 border_place(uint name, uint tone)
{
    return ivec3(pixel_of(name), 1u + tone);
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
