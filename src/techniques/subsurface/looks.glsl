// SPDX-License-Identifier: MIT
// Subsurface parameters of a pixel's material. Define before: LOOKS_BINDING, the binding of the parameter
// sets' texels (the next binding holds each draw call's set); HAS_LOOKS, whether there is more than one set.

#include "shaders/surface_images.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

layout(binding = LOOKS_BINDING) uniform samplerBuffer look_texels;
layout(binding = LOOKS_BINDING + 1) uniform usamplerBuffer look_of_draw;

// Whether the pixel's surface scatters light below it; the ground and the background do not.
bool takes_light_in(uint word)
{
    return !is_paper(word) && (word & DRAW_UNLIT) == 0u;
}

uint look_of(uint word)
{
    return HAS_LOOKS && takes_light_in(word) ? texelFetch(look_of_draw, int(draw_of(word))).x : 0u;
}

// Absorption, and the share of transmitted light in alpha.
vec4 look_through(uint look)
{
    return texelFetch(look_texels, int(3u * look));
}

// Scattering distance of each colour, and the thickness of sheets in alpha.
vec4 look_scatter(uint look)
{
    return texelFetch(look_texels, int(3u * look + 1u));
}

// x: visible share of the background; y: its blur; z: tint by the surface's own colour.
vec3 look_behind(uint look)
{
    return texelFetch(look_texels, int(3u * look + 2u)).xyz;
}
