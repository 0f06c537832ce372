// SPDX-License-Identifier: MIT
// Draws the page of lab_stage.comp with a fragment shader.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "lab_pixels.glsl"

layout(binding = 0) uniform usampler2D from;

layout(location = 0) out uint result;

void main()
{
    result = made_of(texelFetch(from, ivec2(gl_FragCoord.xy), 0).x);
}
