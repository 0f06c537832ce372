// SPDX-License-Identifier: MIT
// One workgroup: sums the volume by which all hot cells expand, and divides it by the sum of the weights of
// the cells that let fluid out.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

const uint threads = 256u;
layout(local_size_x = 256) in;

layout(constant_id = 0) const uint variant = 0u;

layout(scalar, binding = 0) readonly buffer Parts
{
    vec2 parts[];
};

layout(scalar, binding = 1) writeonly buffer Share
{
    float out_share[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidExpansion expansion;
};

shared vec2 sums[threads];

void main()
{
    uint thread = gl_LocalInvocationIndex;
    vec2 own = vec2(0.0);
    for (uint i = thread; i < expansion.part_count; i += threads) {
        own += parts[i];
    }
    sums[thread] = own;
    for (uint stride = threads / 2u; stride > 0u; stride /= 2u) {
        barrier();
        if (thread < stride) {
            sums[thread] += sums[thread + stride];
        }
    }
    if (thread == 0u) {
        out_share[0] = sums[0].y > 0.0 ? sums[0].x / sums[0].y : 0.0;
    }
}
