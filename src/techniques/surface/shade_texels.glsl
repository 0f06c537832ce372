// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADE_TEXELS
#define ESTAMPE_SHADE_TEXELS

// Reads ShadeRecords (one per draw call) as texels of four 32-bit words. Requires SHADE_TEXELS_BINDING.

#include "techniques/surface/shade.glsl.h"

layout(binding = SHADE_TEXELS_BINDING) uniform usamplerBuffer shade_texels;

ShadeRecord shade_at(uint draw)
{
    int first = int(5u * draw);
    uvec4 a = texelFetch(shade_texels, first);
    uvec4 b = texelFetch(shade_texels, first + 1);
    uvec4 c = texelFetch(shade_texels, first + 2);
    uvec4 d = texelFetch(shade_texels, first + 3);
    uvec4 e = texelFetch(shade_texels, first + 4);
    TextureSlot slot = TextureSlot(a.x, uintBitsToFloat(a.yz), uintBitsToFloat(uvec2(a.w, b.x)),
                                   uintBitsToFloat(b.yz), uintBitsToFloat(b.w));
    return ShadeRecord(slot, uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xyz), uintBitsToFloat(d.w),
                       uintBitsToFloat(e.x), uintBitsToFloat(e.y), e.zw);
}

// Whether a draw call has a colour of its own in the shade.
bool has_shade(uint draw)
{
    return (texelFetch(shade_texels, int(5u * draw + 2u)).w & shade_is_there) != 0u;
}

#endif
