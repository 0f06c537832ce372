// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SMEAR_TEXELS
#define ESTAMPE_SMEAR_TEXELS

// Reads smear strokes from texels. The including shader must define SMEAR_TEXELS_BINDING.

#include "techniques/motion_blur/motion_blur.glsl.h"

layout(binding = SMEAR_TEXELS_BINDING) uniform usamplerBuffer stroke_texels;

SmearStroke stroke_at(int number)
{
    vec4 line = uintBitsToFloat(texelFetch(stroke_texels, 2 * number));
    uvec4 rest = texelFetch(stroke_texels, 2 * number + 1);
    return SmearStroke(line.xy, line.zw, uintBitsToFloat(rest.x), uintBitsToFloat(rest.y), rest.z,
                       uintBitsToFloat(rest.w));
}

#endif
