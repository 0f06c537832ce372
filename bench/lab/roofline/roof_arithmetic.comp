// SPDX-License-Identifier: MIT
// Multiply-adds on 32 sums per thread, so that no multiply-add waits for the previous one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) writeonly buffer Results
{
    float results[];
};

layout(push_constant, scalar) uniform Constants
{
    uint threads;
    uint rounds;
    float factor;
    float step_up;
};

void main()
{
    uint i = item_index();
    vec4 a = vec4(float(i), 1.0, 2.0, 3.0);
    vec4 b = a + 4.0;
    vec4 c = a + 8.0;
    vec4 d = a + 12.0;
    vec4 e = a + 16.0;
    vec4 f = a + 20.0;
    vec4 g = a + 24.0;
    vec4 h = a + 28.0;
    for (uint r = 0u; r < rounds; ++r) {
        a = a * factor + step_up;
        b = b * factor + step_up;
        c = c * factor + step_up;
        d = d * factor + step_up;
        e = e * factor + step_up;
        f = f * factor + step_up;
        g = g * factor + step_up;
        h = h * factor + step_up;
        a = a * factor + step_up;
        b = b * factor + step_up;
        c = c * factor + step_up;
        d = d * factor + step_up;
        e = e * factor + step_up;
        f = f * factor + step_up;
        g = g * factor + step_up;
        h = h * factor + step_up;
    }
    vec4 sum = a + b + c + d + e + f + g + h;
    if (i < threads) {
        results[i] = sum.x + sum.y + sum.z + sum.w;
    }
}
