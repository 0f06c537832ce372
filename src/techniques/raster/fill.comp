// SPDX-License-Identifier: MIT
// Fills a buffer with one 32-bit value. Four quads per thread, so that a GPU starts fewer workgroups.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/loops.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Words
{
    uvec4 words[];
};

layout(push_constant) uniform Constants
{
    uint value;
    uint quad_count;
};

void main()
{
    uint first = 4u * (item_index() - gl_LocalInvocationIndex) + gl_LocalInvocationIndex;
    for (uint i = 0u; i < 4u; ++i) {
        uint index = first + 64u * i;
        if (index < quad_count) {
            words[index] = uvec4(value);
        }
    }
}
