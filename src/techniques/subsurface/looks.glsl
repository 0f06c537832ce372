// SPDX-License-Identifier: MIT
// The look of what a pixel sees. Wanted before: LOOKS_BINDING, of the looks as texels; the number of each
// draw's comes next. HAS_LOOKS says whether there is more than one.

#include "shaders/surface_images.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

layout(binding = LOOKS_BINDING) uniform samplerBuffer look_texels;
layout(binding = LOOKS_BINDING + 1) uniform usamplerBuffer look_of_draw;

// Of the ground, and where nothing is seen, light goes into nothing.
bool takes_light_in(uint word)
{
    return !is_paper(word) && (word & DRAW_UNLIT) == 0u;
}

uint look_of(uint word)
{
    return HAS_LOOKS && takes_light_in(word) ? texelFetch(look_of_draw, int(draw_of(word))).x : 0u;
}

// Absorption, and the share of what comes through.
vec4 look_through(uint look)
{
    return texelFetch(look_texels, int(3u * look));
}

// How far each colour spreads, and how thick sheets are.
vec4 look_scatter(uint look)
{
    return texelFetch(look_texels, int(3u * look + 1u));
}

// How much of what lies behind is seen, how blurred, and how much the surface's own colour tints it.
vec3 look_behind(uint look)
{
    return texelFetch(look_texels, int(3u * look + 2u)).xyz;
}
