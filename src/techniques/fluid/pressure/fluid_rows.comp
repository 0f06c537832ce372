// SPDX-License-Identifier: MIT
// One workgroup per few pairs of rows of the grid: transforms the rows forward or backward. Or the workgroup
// solves: it transforms the rows forward, divides each wave by the wave's eigenvalue of the Laplacian, and
// transforms the rows backward.
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

// Fast Fourier transforms of rows along an axis in shared memory. Two rows of real numbers form one complex
// row. `angles` holds cosines and sines of fractions of a full turn.
//
// Forward transforms decimate in frequency, backward transforms decimate in time, both in place. Frequencies
// are in bit-reversed order, so nothing needs to be sorted.
//
// An axis with walls uses cosines (DCT-II, Neumann), a periodic axis a real Fourier transform. Both
// transforms come from A(k), the complex Fourier coefficient of the row at frequency k. With walls the row is
// first reordered after Makhoul ("A fast cosine transform in one and two dimensions", IEEE Transactions on
// Acoustics, Speech, and Signal Processing 28, 1980), and A(k), the Fourier coefficient at frequency k of a
// row with n numbers, is rotated by -k/4n of a full turn. The real part of the Fourier coefficient A(k) of a
// row with n numbers is coefficient k; the negated imaginary part is coefficient n - k.

const int transform_threads = 256;
const int transform_numbers =
    (variant & fluid_bit_long) != 0u ? 2 * int(fluid_transform_pairs) : int(fluid_transform_pairs);

shared float real_part[transform_numbers];
shared float imaginary_part[transform_numbers];

int axis_of_rows()
{
    return (variant & fluid_bit_along_z) != 0u ? 2 : (variant & fluid_bit_along_y) != 0u ? 1 : 0;
}

bool has_walls()
{
    return (variant & (fluid_bit_periodic << axis_of_rows())) == 0u;
}

int row_length()
{
    return 1 << transform.log_length;
}

int numbers_in_group()
{
    return 1 << (transform.log_length + transform.log_pairs);
}

vec2 number_at(int i)
{
    return vec2(real_part[i], imaginary_part[i]);
}

void put_number(int i, vec2 number)
{
    real_part[i] = number.x;
    imaginary_part[i] = number.y;
}

vec2 times(vec2 a, vec2 b)
{
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

vec2 conjugate(vec2 a)
{
    return vec2(a.x, -a.y);
}

vec2 times_i(vec2 a)
{
    return vec2(-a.y, a.x);
}

// Cosine and sine of the angle `part` / 2^log_parts of a full turn.
vec2 angle(int part, int log_parts)
{
    return uintBitsToFloat(texelFetch(angles, part << (int(transform.log_turn) - log_parts)).xy);
}

// Index of frequency `k` of row `row` in shared memory.
int place_of_frequency(int row, int k)
{
    int log_length = int(transform.log_length);
    return (row << log_length) + int(bitfieldReverse(uint(k)) >> (32 - log_length));
}

// Position in the row of the number that enters the transform at index j.
int reordered(int j)
{
    int n = row_length();
    return !has_walls() ? j : 2 * j < n ? 2 * j : 2 * (n - 1 - j) + 1;
}

// Rotation that turns the Fourier coefficient A(k) into the cosine coefficients k and n - k of a row with n
// numbers.
vec2 turn_of(int k)
{
    return has_walls() ? conjugate(angle(k, int(transform.log_length) + 2)) : vec2(1.0, 0.0);
}

void forward_pair()
{
    for (int i = int(gl_LocalInvocationIndex); 2 * i < numbers_in_group(); i += transform_threads) {
        vec2 a = number_at(2 * i);
        vec2 b = number_at(2 * i + 1);
        put_number(2 * i, a + b);
        put_number(2 * i + 1, a - b);
    }
    barrier();
}

void forward_four(int log_quarter)
{
    int quarter = 1 << log_quarter;
    for (int i = int(gl_LocalInvocationIndex); 4 * i < numbers_in_group(); i += transform_threads) {
        int j = i & (quarter - 1);
        int at = ((i >> log_quarter) << (log_quarter + 2)) + j;
        vec2 a = number_at(at);
        vec2 b = number_at(at + quarter);
        vec2 c = number_at(at + 2 * quarter);
        vec2 d = number_at(at + 3 * quarter);
        vec2 once = conjugate(angle(j, log_quarter + 2));
        vec2 twice = conjugate(angle(j, log_quarter + 1));
        vec2 difference = times(a - c, once);
        vec2 turned = -times_i(times(b - d, once));
        put_number(at, (a + c) + (b + d));
        put_number(at + quarter, times((a + c) - (b + d), twice));
        put_number(at + 2 * quarter, difference + turned);
        put_number(at + 3 * quarter, times(difference - turned, twice));
    }
    barrier();
}

void backward_four(int log_quarter)
{
    int quarter = 1 << log_quarter;
    for (int i = int(gl_LocalInvocationIndex); 4 * i < numbers_in_group(); i += transform_threads) {
        int j = i & (quarter - 1);
        int at = ((i >> log_quarter) << (log_quarter + 2)) + j;
        vec2 once = angle(j, log_quarter + 2);
        vec2 twice = angle(j, log_quarter + 1);
        vec2 a = number_at(at);
        vec2 b = times(number_at(at + quarter), twice);
        vec2 c = number_at(at + 2 * quarter);
        vec2 d = times(number_at(at + 3 * quarter), twice);
        vec2 sum = times(c + d, once);
        vec2 turned = times_i(times(c - d, once));
        put_number(at, (a + b) + sum);
        put_number(at + quarter, (a - b) + turned);
        put_number(at + 2 * quarter, (a + b) - sum);
        put_number(at + 3 * quarter, (a - b) - turned);
    }
    barrier();
}

void transform_forward()
{
    int log_quarter = int(transform.log_length) - 2;
    for (; log_quarter >= 0; log_quarter -= 2) {
        forward_four(log_quarter);
    }
    if (log_quarter == -1) {
        forward_pair();
    }
}

// Inverse Fourier transform, unnormalized: the result is multiplied by the length of the row.
void transform_backward()
{
    int log_quarter = int(transform.log_length) & 1;
    if (log_quarter == 1) {
        forward_pair(); // a transform of two numbers equals its inverse, up to a factor
    }
    for (; log_quarter < int(transform.log_length); log_quarter += 2) {
        backward_four(log_quarter);
    }
}

// Separates the Fourier coefficients A(k), at frequency k, of two real rows from the frequencies of the
// complex row that the two rows form.
void untangle(int row, int k, out vec2 first, out vec2 second)
{
    vec2 here = number_at(place_of_frequency(row, k));
    vec2 there = conjugate(number_at(place_of_frequency(row, (row_length() - k) & (row_length() - 1))));
    first = 0.5 * (here + there);
    second = -0.5 * times_i(here - there);
}

// First cell of a pair's first row. The two rows of a pair are neighbours along x, or along y if rows run
// along x.
ivec3 start_of(int pair)
{
    // Sides of the grid are powers of two, so every pair of rows is complete.
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

// Index of number `number` in a pair's first row; the second value is the distance to the second row.
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

// Index of the pair of rows, and of the number within the rows, that a thread processes in unit of work
// number `i`. Neighbouring threads take neighbours along x, so that memory accesses coalesce.
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

// Whether frequency `k` is the first of a pair. In a row with n numbers, the coefficients k and n - k come
// from one frequency; the frequencies 0 and n / 2 have no partner.
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

// Fourier coefficient A(k) at frequency k of a row with n numbers, from the real coefficients k and n - k.
// They are stored at the indices `at` and `at_other`.
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

// Eigenvalue of the wave with frequency `k` for the second difference along an axis of `cells` cells,
// negated.
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

// Factor that turns a wave of divergence into a wave of pressure.
float pressure_of_wave(float across, int k)
{
    float all_stiffness = across + stiffness(k, uint(row_length()), axis_of_rows());
    return all_stiffness > 0.0 ? -1.0 / all_stiffness : 0.0;
}

// Fourier coefficient A(k) at frequency k of a row with n numbers, after the real coefficients k and n - k
// have been divided by the eigenvalues.
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
