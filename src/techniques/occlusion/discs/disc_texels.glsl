// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISC_TEXELS
#define ESTAMPE_DISC_TEXELS

// The tree read as texels. Wanted before: DISCS_BINDING and `constants`, DiscConstants.

#include "techniques/occlusion/discs/discs.glsl.h"

layout(binding = DISCS_BINDING) uniform samplerBuffer disc_texels;

Disc disc_at(uint disc)
{
    vec4 a = texelFetch(disc_texels, int(2u * disc));
    vec4 b = texelFetch(disc_texels, int(2u * disc + 1u));
    return Disc(a.xyz, a.w, b.xyz, b.w);
}

// Of the first node of a level.
uint first_of(uint level)
{
    uint first = 0u;
    for (uint i = 0u; i < level; ++i) {
        first += constants.counts[i];
    }
    return first;
}

#endif
