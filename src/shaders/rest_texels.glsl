// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_REST_TEXELS
#define ESTAMPE_REST_TEXELS

// Reads vertices of the rest pose as texels of four 32-bit words. Requires REST_TEXELS_BINDING.

#include "shaders/scene.glsl.h"

layout(binding = REST_TEXELS_BINDING) uniform usamplerBuffer rest_texels;

RestVertex rest_vertex_at(uint vertex)
{
    uvec4 place = texelFetch(rest_texels, int(3u * vertex));
    vec4 uvs = uintBitsToFloat(texelFetch(rest_texels, int(3u * vertex + 1u)));
    uint color = texelFetch(rest_texels, int(3u * vertex + 2u)).x;
    return RestVertex(uintBitsToFloat(place.xyz), place.w, uvs.xy, uvs.zw, color, uvec3(0u));
}

#endif
