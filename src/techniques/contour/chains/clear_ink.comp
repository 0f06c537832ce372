// SPDX-License-Identifier: MIT
// One thread blanks four pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/items.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) writeonly buffer Inked
{
    uvec4 inked[];
};

layout(push_constant, scalar) uniform Constants
{
    uint count;
};

void main()
{
    uint index = item_index();
    if (index < count) {
        inked[index] = uvec4(0u);
    }
}
