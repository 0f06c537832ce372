// SPDX-License-Identifier: MIT
// One workgroup a few pairs of rows: their transform, or back.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 256) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer numbers;
layout(binding = 1) uniform usamplerBuffer angles;

layout(scalar, binding = 2) writeonly buffer Numbers
{
    float out_numbers[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidTransform transform;
};

const int axis_of_rows = 0;

#include "techniques/fluid/pressure/fluid_transform.glsl"

// The first number of the first row of a pair.
int start_of_pair(int pair)
{
    int first = int(gl_WorkGroupID.x) << transform.log_pairs;
    return 2 * (first + pair) * row_length();
}

void forward()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int at = start_of_pair(i >> transform.log_length) + reordered(i & (n - 1));
        put_number(i, vec2(texelFetch(numbers, at).x, texelFetch(numbers, at + n).x));
    }
    barrier();
    transform_forward();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int pair = i >> transform.log_length;
        int k = i & (n - 1);
        int low = min(k, n - k);
        vec2 first;
        vec2 second;
        untangle(pair, low, first, second);
        first = times(first, turn_of(low));
        second = times(second, turn_of(low));
        int at = start_of_pair(pair) + k;
        out_numbers[at] = low == k ? first.x : -first.y;
        out_numbers[at + n] = low == k ? second.x : -second.y;
    }
}

// Coefficient k turned, where `low` is k or n - k, the lower of both.
vec2 coefficient(int start, int low)
{
    int n = row_length();
    float imaginary =
        low == 0 || 2 * low == n && !has_walls() ? 0.0 : -texelFetch(numbers, start + n - low).x;
    return times(vec2(texelFetch(numbers, start + low).x, imaginary), conjugate(turn_of(low)));
}

void backward()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int pair = i >> transform.log_length;
        int k = i & (n - 1);
        int low = min(k, n - k);
        vec2 first = coefficient(start_of_pair(pair), low);
        vec2 second = coefficient(start_of_pair(pair) + n, low);
        vec2 both = low == k ? first + times_i(second) : conjugate(first) + times_i(conjugate(second));
        put_number(place_of_frequency(pair, k), both);
    }
    barrier();
    transform_backward();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int at = start_of_pair(i >> transform.log_length) + reordered(i & (n - 1));
        vec2 both = transform.share * number_at(i);
        out_numbers[at] = both.x;
        out_numbers[at + n] = both.y;
    }
}

void main()
{
    if ((variant & fluid_bit_reversed) == 0u) {
        forward();
    } else {
        backward();
    }
}
