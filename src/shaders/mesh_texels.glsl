// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MESH_TEXELS
#define ESTAMPE_MESH_TEXELS

// Reads triangles and posed vertices as texels of four words, because CPUs read several texels in one
// instruction. Requires MESH_TEXELS_BINDING for the triangles; the next binding is that of the posed
// vertices.

#include "shaders/scene.glsl.h"

layout(binding = MESH_TEXELS_BINDING) uniform usamplerBuffer triangle_texels;
layout(binding = MESH_TEXELS_BINDING + 1) uniform usamplerBuffer posed_vertex_texels;

// A triangle: three indices of posed vertices, then the number of the draw call with the flags of
// scene.glsl.h.
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
