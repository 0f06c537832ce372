// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VISIBILITY_TEXELS
#define ESTAMPE_VISIBILITY_TEXELS

// Reads the visibility buffer as texels, because CPUs read several texels in one instruction. Requires
// VISIBILITY_BINDING and `frame`, a FrameGlobals.

#include "shaders/visibility.glsl"

layout(binding = VISIBILITY_BINDING) uniform usamplerBuffer visibility_texels;

// The word of the visibility buffer at a pixel of the page.
uvec2 visibility_at(ivec2 pixel)
{
    return texelFetch(visibility_texels, pixel.y * int(frame.size_px.x) + pixel.x).xy;
}

#endif
