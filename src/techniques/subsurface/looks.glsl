// SPDX-License-Identifier: MIT
// The look of what a pixel sees. Wanted before: LOOKS_BINDING, of the looks; the number of each draw's comes
// next. HAS_LOOKS says whether there is more than one.

#include "shaders/draw_word.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

layout(scalar, binding = LOOKS_BINDING) readonly buffer Looks
{
    SubsurfaceLook looks[];
};

layout(scalar, binding = LOOKS_BINDING + 1) readonly buffer LookOfDraw
{
    uint look_of_draw[];
};

// Of the ground, and where nothing is seen, light goes into nothing.
bool takes_light_in(uint word)
{
    return !is_paper(word) && (word & DRAW_UNLIT) == 0u;
}

uint look_of(uint word)
{
    return HAS_LOOKS && takes_light_in(word) ? look_of_draw[draw_of(word)] : 0u;
}
