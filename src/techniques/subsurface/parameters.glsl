// SPDX-License-Identifier: MIT
// Subsurface parameters of a pixel's material. Define before: PARAMETERS_BINDING, the binding of the
// parameter sets' texels (the next binding holds each draw call's set); HAS_VARIANTS, whether there is more
// than one set.

#include "shaders/surface_images.glsl"
#include "techniques/subsurface/subsurface.glsl.h"

layout(binding = PARAMETERS_BINDING) uniform samplerBuffer parameter_texels;
layout(binding = PARAMETERS_BINDING + 1) uniform usamplerBuffer variant_of_draw;

// Whether the pixel's surface scatters light below itself; the ground and the background do not.
bool takes_light_in(uint word)
{
    return !is_paper(word) && (word & DRAW_UNLIT) == 0u;
}

uint style_variant_of(uint word)
{
    return HAS_VARIANTS && takes_light_in(word) ? texelFetch(variant_of_draw, int(draw_of(word))).x : 0u;
}

// Absorption of a material per metre; the share of transmitted light in alpha.
vec4 light_through(uint style_variant)
{
    return texelFetch(parameter_texels, int(3u * style_variant));
}

// Scattering distance of each colour in a material; the thickness of sheets in alpha.
vec4 scatter_of(uint style_variant)
{
    return texelFetch(parameter_texels, int(3u * style_variant + 1u));
}

// Index of refraction of a clear material; 1 if the view ray passes straight.
float ior_of(uint style_variant)
{
    return texelFetch(parameter_texels, int(3u * style_variant + 2u)).w;
}

// Appearance of the background behind a clear material. x: visible share of the background; y: its blur; z:
// tint by the surface's own colour.
vec3 behind_of(uint style_variant)
{
    return texelFetch(parameter_texels, int(3u * style_variant + 2u)).xyz;
}
