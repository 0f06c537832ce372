// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_TRANSFORM
#define ESTAMPE_FLUID_TRANSFORM

// Fast transforms of rows along an axis in shared memory, two rows of real numbers as one of complex ones.
// Needs `variant`; `transform`, a FluidTransform; `angles`, a texel buffer of cosines and sines of a full
// turn's parts.
//
// Forward goes by decimation in frequency, backward by decimation in time, both in place, so that frequencies
// stand in bit-reversed order and nothing needs to be sorted.
//
// An axis with walls has cosines (DCT-II, Neumann), one without a real Fourier transform. Both come of the
// complex transform of the row, for walls reordered after Makhoul ("A fast cosine transform in one and two
// dimensions", IEEE Transactions on Acoustics, Speech, and Signal Processing 28, 1980): with A(k) of one row
// turned by -k/4n of a full turn for walls, and not at all else, its real part is coefficient k and its
// imaginary part less than zero coefficient n - k.

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

// Cosine and sine of `part` of 2^log_parts parts of a full turn.
vec2 angle(int part, int log_parts)
{
    return uintBitsToFloat(texelFetch(angles, part << (int(transform.log_turn) - log_parts)).xy);
}

// Where frequency `k` of row `row` stands.
int place_of_frequency(int row, int k)
{
    int log_length = int(transform.log_length);
    return (row << log_length) + int(bitfieldReverse(uint(k)) >> (32 - log_length));
}

// The number of a row that is transformed as its j-th.
int reordered(int j)
{
    int n = row_length();
    return !has_walls() ? j : 2 * j < n ? 2 * j : 2 * (n - 1 - j) + 1;
}

// Coefficient k turned, from the row's own A(k).
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

// What comes out is as many times too large as the row has numbers.
void transform_backward()
{
    int log_quarter = int(transform.log_length) & 1;
    if (log_quarter == 1) {
        forward_pair(); // its own inverse, but for the factor
    }
    for (; log_quarter < int(transform.log_length); log_quarter += 2) {
        backward_four(log_quarter);
    }
}

// The two rows' A(k) from the frequencies of both as one complex row.
void untangle(int row, int k, out vec2 first, out vec2 second)
{
    vec2 here = number_at(place_of_frequency(row, k));
    vec2 there = conjugate(number_at(place_of_frequency(row, (row_length() - k) & (row_length() - 1))));
    first = 0.5 * (here + there);
    second = -0.5 * times_i(here - there);
}

#endif
