// SPDX-License-Identifier: MIT
// One workgroup a few pairs of rows along an axis: their transform, or back; or there, each wave divided by
// what the sum of differences to the neighbours makes of it, and back.
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

#include "techniques/fluid/pressure/fluid_transform.glsl"

// The cell that the first row of a pair begins with. Two rows of a pair are neighbours along x, or along y if
// rows themselves run along x.
ivec3 start_of(int pair)
{
    // Sides are powers of two.
    int first = 2 * ((int(gl_WorkGroupID.x) << transform.log_pairs) + pair);
    int side = int(axis_of_rows() == 0 ? transform.height : transform.width);
    int within = first & (side - 1);
    int across = first >> findMSB(side);
    return axis_of_rows() == 0   ? ivec3(0, within, across)
           : axis_of_rows() == 1 ? ivec3(within, 0, across)
                                 : ivec3(within, across, 0);
}

int index_of(ivec3 cell)
{
    return (cell.z * int(transform.height) + cell.y) * int(transform.width) + cell.x;
}

// Where the number of a pair's first row is, and how much farther that of the second.
int place_of_number(int pair, int number)
{
    ivec3 cell = start_of(pair);
    cell[axis_of_rows()] = number;
    return index_of(cell);
}

int to_second_row()
{
    return axis_of_rows() == 0 ? int(transform.width) : 1;
}

// Which pair, and which number of its rows: neighbouring threads take neighbours along x.
ivec2 work_of(int i)
{
    return axis_of_rows() == 0 ? ivec2(i >> transform.log_length, i & (row_length() - 1))
                               : ivec2(i & ((1 << transform.log_pairs) - 1), i >> transform.log_pairs);
}

void read_rows()
{
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 work = work_of(i);
        int at = place_of_number(work.x, reordered(work.y));
        put_number((work.x << transform.log_length) + work.y,
                   vec2(texelFetch(numbers, at).x, texelFetch(numbers, at + to_second_row()).x));
    }
    barrier();
}

void write_rows()
{
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 work = work_of(i);
        int at = place_of_number(work.x, reordered(work.y));
        vec2 both = transform.share * number_at((work.x << transform.log_length) + work.y);
        out_numbers[at] = both.x;
        out_numbers[at + to_second_row()] = both.y;
    }
}

// Coefficients k and n - k, of which the first alone stands for itself where k is 0 or half of n, come of one
// frequency.
bool is_first_of_two(int k)
{
    return 2 * k <= row_length();
}

bool has_other(int k)
{
    return k > 0 && 2 * k < row_length();
}

void write_coefficients()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 work = work_of(i);
        if (is_first_of_two(work.y)) {
            vec2 first;
            vec2 second;
            untangle(work.x, work.y, first, second);
            first = times(first, turn_of(work.y));
            second = times(second, turn_of(work.y));
            int at = place_of_number(work.x, work.y);
            out_numbers[at] = first.x;
            out_numbers[at + to_second_row()] = second.x;
            if (has_other(work.y)) {
                int at_other = place_of_number(work.x, n - work.y);
                out_numbers[at_other] = -first.y;
                out_numbers[at_other + to_second_row()] = -second.y;
            }
        }
    }
}

// A(k) from coefficients k and n - k, which stand at two places.
vec2 from_coefficients(int k, int at, int at_other)
{
    bool is_real = k == 0 || 2 * k == row_length() && !has_walls();
    vec2 turned = vec2(texelFetch(numbers, at).x, is_real ? 0.0 : -texelFetch(numbers, at_other).x);
    return times(turned, conjugate(turn_of(k)));
}

void read_coefficients()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        ivec2 work = work_of(i);
        if (is_first_of_two(work.y)) {
            int at = place_of_number(work.x, work.y);
            int at_other = place_of_number(work.x, (n - work.y) & (n - 1));
            vec2 first = from_coefficients(work.y, at, at_other);
            vec2 second = from_coefficients(work.y, at + to_second_row(), at_other + to_second_row());
            put_number(place_of_frequency(work.x, work.y), first + times_i(second));
            if (has_other(work.y)) {
                put_number(place_of_frequency(work.x, n - work.y),
                           conjugate(first) + times_i(conjugate(second)));
            }
        }
    }
    barrier();
}

// What the sum of differences to both neighbours along an axis takes of wave k, of so many cells.
float stiffness(int k, uint cells, int axis)
{
    bool is_periodic = (variant & (fluid_bit_periodic << axis)) != 0u;
    float sine = angle(k, findMSB(cells) + (is_periodic ? 1 : 2)).y;
    return 4.0 * sine * sine;
}

float stiffness_across(ivec3 start)
{
    float sum = stiffness(start.x, transform.width, 0);
    return axis_of_rows() == 2 ? sum + stiffness(start.y, transform.height, 1) : sum;
}

// What a wave of pressure is, of a wave of divergence.
float pressure_of_wave(float across, int k)
{
    float all_stiffness = across + stiffness(k, uint(row_length()), axis_of_rows());
    return all_stiffness > 0.0 ? -1.0 / all_stiffness : 0.0;
}

// A(k) of a row, its coefficients k and n - k each divided.
vec2 divided(vec2 wave, float across, int k)
{
    int n = row_length();
    vec2 turned = times(wave, turn_of(k));
    turned *= vec2(pressure_of_wave(across, k), pressure_of_wave(across, (n - k) & (n - 1)));
    return times(turned, conjugate(turn_of(k)));
}

void divide()
{
    int n = row_length();
    for (int i = int(gl_LocalInvocationIndex); i < numbers_in_group(); i += transform_threads) {
        int pair = i >> transform.log_length;
        int k = i & (n - 1);
        if (is_first_of_two(k)) {
            vec2 first;
            vec2 second;
            untangle(pair, k, first, second);
            ivec3 start = start_of(pair);
            first = divided(first, stiffness_across(start), k);
            second = divided(second, stiffness_across(start + ivec3(1, 0, 0)), k);
            put_number(place_of_frequency(pair, k), first + times_i(second));
            if (has_other(k)) {
                put_number(place_of_frequency(pair, n - k), conjugate(first) + times_i(conjugate(second)));
            }
        }
    }
    barrier();
}

void main()
{
    if ((variant & fluid_bit_reversed) != 0u) {
        read_coefficients();
        transform_backward();
        write_rows();
        return;
    }
    read_rows();
    transform_forward();
    if ((variant & fluid_bit_dividing) == 0u) {
        write_coefficients();
        return;
    }
    divide();
    transform_backward();
    write_rows();
}
