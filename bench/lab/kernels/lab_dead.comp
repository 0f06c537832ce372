// SPDX-License-Identifier: MIT
// Sixteen texture reads whose results hardly matter, do not matter, or only seem not to matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_compute.glsl"

layout(binding = 1) uniform sampler2D picture;

const uint times_little = 0u;
const uint times_zero = 1u;
const uint times_unknown_zero = 2u;
const uint not_used = 3u;
const uint used_if_never = 4u;
const uint one_place = 5u; // reads one place sixteen times

float sum_of_reads(uint i)
{
    float sum = 0.0;
    for (uint k = 0u; k < 16u; ++k) {
        uint p = (variant == one_place ? scattered(i) : scattered(16u * i + k)) & a;
        sum += texelFetch(picture, ivec2(p & ((1u << b) - 1u), p >> b), 0).x;
    }
    return sum;
}

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    float sum = sum_of_reads(i);
    float result = 1.0;
    if (variant == times_zero) {
        result += sum * 0.00000000;
    } else if (variant == times_unknown_zero) {
        result += sum * float(rounds);
    } else if (variant == used_if_never) {
        result = sum < 0.0 ? sum : result;
    } else if (variant != not_used) {
        result += sum * 0.00000001;
    }
    results[i] = floatBitsToUint(result);
}
