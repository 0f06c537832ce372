// SPDX-License-Identifier: MIT
// One workgroup a few pairs of columns of transformed rows: transforms them, divides each wave by what the
// sum of differences to the neighbours makes of it, and transforms back.
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

const int axis_of_rows = 1;

#include "techniques/fluid/pressure/fluid_transform.glsl"

int first_pair()
{
    return int(gl_WorkGroupID.x) << transform.log_pairs;
}

// Neighbouring threads take neighbouring columns: which pair, and which number of the column.
ivec2 place_of_thread(int i)
{
    return ivec2(i & ((1 << transform.log_pairs) - 1), i >> transform.log_pairs);
}

int index_of(int pair, int row)
{
    return row * int(transform.width) + 2 * (first_pair() + pair);
}

// What the sum of differences to both neighbours along an axis takes of wave k, of so many cells.
float stiffness(int k, int log_cells, int axis)
{
    bool is_periodic = (variant & (fluid_bit_periodic << axis)) != 0u;
    float sine = angle(k, log_cells + (is_periodic ? 1 : 2)).y;
    return 4.0 * sine * sine;
}

// What a wave of pressure is, of a wave of divergence.
float pressure_of_wave(float stiffness_x, int k)
{
    float all_stiffness = stiffness_x + stiffness(k, int(transform.log_length), 1);
    return all_stiffness > 0.0 ? -1.0 / all_stiffness : 0.0;
}

// A(k) of one column, its coefficients k and n - k each divided.
vec2 divided(vec2 wave, int column, int k)
{
    int n = row_length();
    float stiffness_x = stiffness(column, findMSB(transform.width), 0);
    vec2 turned = times(wave, turn_of(k));
    turned *= vec2(pressure_of_wave(stiffness_x, k), pressure_of_wave(stiffness_x, (n - k) & (n - 1)));
    return times(turned, conjugate(turn_of(k)));
}

void divide()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int pair = i >> transform.log_length;
        int k = i & (n - 1);
        if (2 * k <= n) {
            vec2 first;
            vec2 second;
            untangle(pair, k, first, second);
            int column = 2 * (first_pair() + pair);
            first = divided(first, column, k);
            second = divided(second, column + 1, k);
            put_number(place_of_frequency(pair, k), first + times_i(second));
            if (k > 0 && 2 * k < n) {
                put_number(place_of_frequency(pair, n - k), conjugate(first) + times_i(conjugate(second)));
            }
        }
    }
    barrier();
}

void main()
{
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 place = place_of_thread(i);
        int at = index_of(place.x, reordered(place.y));
        put_number((place.x << transform.log_length) + place.y,
                   vec2(texelFetch(numbers, at).x, texelFetch(numbers, at + 1).x));
    }
    barrier();
    transform_forward();
    divide();
    transform_backward();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 place = place_of_thread(i);
        int at = index_of(place.x, reordered(place.y));
        vec2 both = transform.share * number_at((place.x << transform.log_length) + place.y);
        out_numbers[at] = both.x;
        out_numbers[at + 1] = both.y;
    }
}
