// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FACING
#define ESTAMPE_FACING

// Tells which triangles face the eye, after all triangles of a shell (connected surface) are given a
// consistent winding. Requires before inclusion: FACING_BINDING (a buffer with one bit per triangle) and
// `neighbor_texels`.

#include "techniques/contour/chains/chains.glsl.h"

layout(binding = FACING_BINDING) uniform usamplerBuffer facing_texels;

bool is_front(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_turned) != 0u;
    uint word = texelFetch(facing_texels, int(triangle / 32u)).x;
    return (word >> (triangle & 31u) & 1u) != (is_turned ? 1u : 0u);
}

#endif
