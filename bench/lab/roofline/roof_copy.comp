// SPDX-License-Identifier: MIT
// Copies 16 bytes per thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer From
{
    uvec4 from[];
};

layout(scalar, binding = 1) writeonly buffer To
{
    uvec4 to[];
};

layout(push_constant, scalar) uniform Constants
{
    uint count;
};

void main()
{
    uint i = item_index();
    if (i < count) {
        to[i] = from[i];
    }
}
