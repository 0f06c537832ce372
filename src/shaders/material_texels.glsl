// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MATERIAL_TEXELS
#define ESTAMPE_MATERIAL_TEXELS

// Reads materials as texels of four 32-bit words, but only the required fields. Requires
// MATERIAL_TEXELS_BINDING.

#include "shaders/scene.glsl.h"

layout(binding = MATERIAL_TEXELS_BINDING) uniform usamplerBuffer material_texels;

uvec4 material_words(uint material, uint texel)
{
    return texelFetch(material_texels, int(11u * material + texel));
}

vec4 base_color_of(uint material)
{
    return uintBitsToFloat(material_words(material, 0u));
}

vec3 mean_color_of(uint material)
{
    return uintBitsToFloat(material_words(material, 1u).xyz);
}

uint flags_of(uint material)
{
    return material_words(material, 1u).w;
}

vec3 shade_color_of(uint material)
{
    return uintBitsToFloat(material_words(material, 2u).xyz);
}

float alpha_cutoff_of(uint material)
{
    return uintBitsToFloat(material_words(material, 2u).w);
}

vec3 outline_color_of(uint material)
{
    return uintBitsToFloat(material_words(material, 3u).xyz);
}

// Width of a material's own outline; 0 means the width of the style's outline.
float outline_width_m_of(uint material)
{
    return uintBitsToFloat(material_words(material, 3u).w);
}

vec3 emissive_of(uint material)
{
    return uintBitsToFloat(material_words(material, 4u).xyz);
}

// Texture number `nth` of a material: 0 base colour, 1 normal, 2 occlusion.
TextureSlot texture_of(uint material, uint nth)
{
    uint texel = 5u + 2u * nth;
    uvec4 a = material_words(material, texel);
    vec4 b = uintBitsToFloat(material_words(material, texel + 1u));
    return TextureSlot(a.x, uintBitsToFloat(a.yz), vec2(uintBitsToFloat(a.w), b.x), b.yz, b.w);
}

TextureSlot base_texture_of(uint material)
{
    return texture_of(material, 0u);
}

TextureSlot normal_texture_of(uint material)
{
    return texture_of(material, 1u);
}

TextureSlot occlusion_texture_of(uint material)
{
    return texture_of(material, 2u);
}

#endif
