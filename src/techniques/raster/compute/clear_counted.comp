// SPDX-License-Identifier: MIT
// Clears a picture, four quads per thread, and the counters of its first batch, which saves a separate pass
// and its barrier.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/raster/raster.glsl.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Words
{
    uvec4 words[];
};

layout(scalar, binding = 1) writeonly buffer Counters
{
    RasterCounters counters;
};

layout(push_constant) uniform Constants
{
    uint quad_count;
};

void main()
{
    if (item_index() == 0u) {
        counters = RasterCounters(0u, 0u);
    }
    uint first = 4u * (item_index() - gl_LocalInvocationIndex) + gl_LocalInvocationIndex;
    for (uint i = 0u; i < 4u; ++i) {
        uint index = first + 64u * i;
        if (index < quad_count) {
            words[index] = uvec4(0u);
        }
    }
}
