// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DUAL_MATH
#define ESTAMPE_DUAL_MATH

// The arithmetic of height graphs, for GLSL and C++. `Real` is float or double. A value is a dual number: the
// value and its derivatives by the coordinates x and z and by the time t. So slopes and speeds are exact.
// Only sums, products, quotients and roots are used, because sines and powers differ between devices.

Real4 dual(Real value)
{
    return Real4(value, Real(0), Real(0), Real(0));
}

Real4 dual_mul(Real4 a, Real4 b)
{
    Real4 r = a * b.x + b * a.x;
    r.x = a.x * b.x;
    return r;
}

Real4 dual_div(Real4 a, Real4 b)
{
    Real inverse = Real(1) / b.x;
    Real4 r = (a - b * (a.x * inverse)) * inverse;
    r.x = a.x * inverse;
    return r;
}

// Applies a function to a dual number, given the function's value and derivative at `a`.
Real4 dual_chain(Real4 a, Real value, Real derivative)
{
    Real4 r = a * derivative;
    r.x = value;
    return r;
}

Real4 dual_min(Real4 a, Real4 b)
{
    if (a.x <= b.x) {
        return a;
    }
    return b;
}

Real4 dual_max(Real4 a, Real4 b)
{
    if (a.x >= b.x) {
        return a;
    }
    return b;
}

Real4 dual_abs(Real4 a)
{
    if (a.x >= Real(0)) {
        return a;
    }
    return -a;
}

Real real_floor(Real x)
{
    return floor(x);
}

// Returns sin(2 pi x) with an error of at most 1e-7.
Real sine_of_turns(Real x)
{
    Real t = x - real_floor(x + Real(0.5));
    if (t > Real(0.25)) {
        t = Real(0.5) - t;
    }
    if (t < Real(-0.25)) {
        t = Real(-0.5) - t;
    }
    Real a = t * Real(6.283185307179586);
    Real s = a * a;
    Real sum = Real(1.0 / 6227020800.0);
    sum = sum * s - Real(1.0 / 39916800.0);
    sum = sum * s + Real(1.0 / 362880.0);
    sum = sum * s - Real(1.0 / 5040.0);
    sum = sum * s + Real(1.0 / 120.0);
    sum = sum * s - Real(1.0 / 6.0);
    return a + a * s * sum;
}

Real4 dual_sine_of_turns(Real4 a)
{
    return dual_chain(a, sine_of_turns(a.x),
                      Real(6.283185307179586) * sine_of_turns(a.x - real_floor(a.x) + Real(0.25)));
}

Real4 dual_sin(Real4 a)
{
    return dual_sine_of_turns(a * Real(0.15915494309189535));
}

Real4 dual_cos(Real4 a)
{
    Real4 turns = a * Real(0.15915494309189535);
    turns.x = turns.x - real_floor(turns.x) + Real(0.25);
    return dual_sine_of_turns(turns);
}

// Square root of a dual number; 0 for a negative value.
Real4 dual_sqrt(Real4 a)
{
    if (a.x <= Real(0)) {
        return dual(Real(0));
    }
    Real root = sqrt(a.x);
    return dual_chain(a, root, Real(0.5) / root);
}

// Base-2 logarithm of a positive number; 0 for other numbers. Computed by a series with an error of at most
// 1e-7.
Real log2_of(Real x)
{
    if (x <= Real(0)) {
        return Real(0);
    }
    Real exponent = Real(0);
    for (int i = 0; i < 140 && x >= Real(1.4142135623730951); ++i) {
        x = x * Real(0.5);
        exponent = exponent + Real(1);
    }
    for (int j = 0; j < 140 && x < Real(0.7071067811865476); ++j) {
        x = x * Real(2);
        exponent = exponent - Real(1);
    }
    Real t = (x - Real(1)) / (x + Real(1));
    Real s = t * t;
    Real sum = Real(1.0 / 11.0);
    sum = sum * s + Real(1.0 / 9.0);
    sum = sum * s + Real(1.0 / 7.0);
    sum = sum * s + Real(1.0 / 5.0);
    sum = sum * s + Real(1.0 / 3.0);
    return exponent + (t + t * s * sum) * Real(2.8853900817779268);
}

Real two_to(Real x)
{
    if (x < Real(-120)) {
        return Real(0);
    }
    Real whole = real_floor(x + Real(0.5));
    Real a = (x - whole) * Real(0.6931471805599453);
    Real sum = Real(1.0 / 5040.0);
    sum = sum * a + Real(1.0 / 720.0);
    sum = sum * a + Real(1.0 / 120.0);
    sum = sum * a + Real(1.0 / 24.0);
    sum = sum * a + Real(1.0 / 6.0);
    sum = sum * a + Real(0.5);
    sum = sum * a + Real(1);
    Real power = sum * a + Real(1);
    for (int i = 0; i < 120 && whole > Real(0); ++i) {
        power = power * Real(2);
        whole = whole - Real(1);
    }
    for (int j = 0; j < 120 && whole < Real(0); ++j) {
        power = power * Real(0.5);
        whole = whole + Real(1);
    }
    return power;
}

// Power of a dual number with a constant exponent; 0 unless `a` is positive.
Real4 dual_pow(Real4 a, Real exponent)
{
    if (a.x <= Real(0)) {
        return dual(Real(0));
    }
    Real power = two_to(exponent * log2_of(a.x));
    return dual_chain(a, power, exponent * power / a.x);
}

Real4 dual_lerp(Real4 a, Real4 b, Real4 share)
{
    return a + dual_mul(b - a, share);
}

Real4 dual_smoothstep(Real4 low, Real4 high, Real4 a)
{
    Real4 t = dual_div(a - low, high - low);
    if (t.x <= Real(0)) {
        return dual(Real(0));
    }
    if (t.x >= Real(1)) {
        return dual(Real(1));
    }
    return dual_chain(t, t.x * t.x * (Real(3) - Real(2) * t.x), Real(6) * t.x * (Real(1) - t.x));
}

// The maximum of two values, with a rounded transition where the values differ by less than `width`.
Real4 dual_smooth_max(Real4 a, Real4 b, Real width)
{
    Real4 apart = dual_abs(a - b);
    Real4 greater = dual_max(a, b);
    if (apart.x >= width) {
        return greater;
    }
    Real4 near = dual(Real(1)) - apart * (Real(1) / width);
    return greater + dual_mul(near, near) * (Real(0.25) * width);
}

// Angle of the vector (u, v), in radians.
Real angle_of(Real u, Real v)
{
    Real across = u < Real(0) ? -u : u;
    Real along = v < Real(0) ? -v : v;
    bool is_steep = along > across;
    Real small = is_steep ? across : along;
    Real large = is_steep ? along : across;
    Real t = large > Real(0) ? small / large : Real(0);
    t = t / (Real(1) + sqrt(Real(1) + t * t));
    t = t / (Real(1) + sqrt(Real(1) + t * t));
    Real s = t * t;
    Real sum = Real(1.0 / 9.0);
    sum = sum * s - Real(1.0 / 7.0);
    sum = sum * s + Real(1.0 / 5.0);
    sum = sum * s - Real(1.0 / 3.0);
    Real angle = Real(4) * (t + t * s * sum);
    if (is_steep) {
        angle = Real(1.5707963267948966) - angle;
    }
    if (u < Real(0)) {
        angle = Real(3.141592653589793) - angle;
    }
    return v < Real(0) ? -angle : angle;
}

Real4 dual_angle(Real4 u, Real4 v)
{
    Real square = u.x * u.x + v.x * v.x;
    if (square <= Real(0)) {
        return dual(Real(0));
    }
    Real4 r = (v * u.x - u * v.x) * (Real(1) / square);
    r.x = angle_of(u.x, v.x);
    return r;
}

Real4 dual_radius(Real4 u, Real4 v)
{
    return dual_sqrt(dual_mul(u, u) + dual_mul(v, v));
}

#endif
