// SPDX-License-Identifier: MIT
// Uses the values that the vertex shader computed, or computes them per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_pixels.glsl"

layout(location = 0) in float across;
layout(location = 0) out float result;

void main()
{
    result = (variant & at_corners) != 0u ? across : worked_on(across);
}
