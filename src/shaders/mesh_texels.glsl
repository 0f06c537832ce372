// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MESH_TEXELS
#define ESTAMPE_MESH_TEXELS

// Triangles and posed vertices read as texels of four words, which processors gather several at once.
// Wanted before: MESH_TEXELS_BINDING, of the triangles; that of the posed vertices comes next.

#include "shaders/scene.glsl.h"

layout(binding = MESH_TEXELS_BINDING) uniform usamplerBuffer triangle_texels;
layout(binding = MESH_TEXELS_BINDING + 1) uniform usamplerBuffer posed_vertex_texels;

// Three posed vertices, then the draw and the flags of scene.glsl.h.
uvec4 triangle_at(uint triangle)
{
    return texelFetch(triangle_texels, int(triangle));
}

PosedVertex posed_vertex_at(uint vertex)
{
    uvec4 words = texelFetch(posed_vertex_texels, int(vertex));
    return PosedVertex(uintBitsToFloat(words.xyz), words.w);
}

#endif
