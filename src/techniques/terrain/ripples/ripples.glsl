// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RIPPLES
#define ESTAMPE_RIPPLES

// The shape of sand ripples, in GLSL that tests also compile as C++.

#include "shaders/hash.glsl"

const float ripple_turn = 6.2831853f;

// Asymmetry of a ripple. The ripple's lee face is (1 + ripple_skew) times as steep as a sine wave.
const float ripple_skew = 0.55f;

// A wave of unit height along the wind, one wavelength long. Each corner of a lattice has its own phase and
// direction; where corners disagree, waves end and fork. Members: the value of the wave and its derivatives
// along and across the wind, as complex numbers.
struct RippleWave {
    vec2 z;
    vec2 z_along;
    vec2 z_across;
};

float ripple_number(ivec2 corner, uint seed)
{
    return 2.0f * unit_float(hash(uint(corner.x), uint(corner.y), seed)) - 1.0f;
}

RippleWave ripple_wave(ivec2 cell, vec2 at, float meander)
{
    vec2 whole = floor(at);
    cell = cell + ivec2(whole);
    vec2 f = at - whole;
    vec2 smooth_f = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    vec2 slope_f = 30.0f * f * f * (f * (f - 2.0f) + 1.0f);
    RippleWave sum;
    sum.z = vec2(0.0f);
    sum.z_along = vec2(0.0f);
    sum.z_across = vec2(0.0f);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 from = f - vec2(corner);
        vec2 w = vec2(corner.x == 1 ? smooth_f.x : 1.0f - smooth_f.x,
                      corner.y == 1 ? smooth_f.y : 1.0f - smooth_f.y);
        vec2 w_slope = vec2(corner.x == 1 ? slope_f.x : -slope_f.x, corner.y == 1 ? slope_f.y : -slope_f.y);
        ivec2 place = cell + corner;
        vec2 turns = meander * vec2(0.5f * ripple_number(place, 11u), 1.4f * ripple_number(place, 12u));
        float phase =
            ripple_turn * (meander * ripple_number(place, 13u) + turns.x * from.x + turns.y * from.y);
        vec2 e = vec2(cos(phase), sin(phase));
        vec2 turned = vec2(-e.y, e.x);
        sum.z = sum.z + w.x * w.y * e;
        sum.z_along = sum.z_along + w_slope.x * w.y * e + (w.x * w.y * ripple_turn * turns.x) * turned;
        sum.z_across = sum.z_across + w.x * w_slope.y * e + (w.x * w.y * ripple_turn * turns.y) * turned;
    }
    return sum;
}

// Slope of rippled sand along and across the wind, for ripples whose height equals their wavelength. `cells`
// is the size of a lattice cell in wavelengths; along the wind it is a whole number.
vec2 ripple_lean(ivec2 cell, vec2 at, float meander, vec2 cells)
{
    RippleWave wave = ripple_wave(cell, at, meander);
    float strength = dot(wave.z, wave.z);
    // Division by the wave's strength: where ripples end, the strength is small, and the added constant makes
    // the sand flat.
    float calm = 1.0f / (strength + 0.06f);
    vec2 drift = vec2(wave.z.x * wave.z_along.y - wave.z.y * wave.z_along.x,
                      wave.z.x * wave.z_across.y - wave.z.y * wave.z_across.x);
    // Change of the wave's phase along and across the wind, in turns per wavelength.
    vec2 phase_slope = vec2(strength, 0.0f) + drift / (ripple_turn * cells);
    float carrier = cells.x * (at.x - floor(at.x));
    float t = ripple_turn * (carrier - floor(carrier)) + atan(wave.z.y, wave.z.x);
    float psi = t - ripple_skew * cos(t);
    float fall = 0.5f * ripple_turn * sin(psi) * (1.0f + ripple_skew * sin(t));
    return phase_slope * (-fall * calm);
}

#endif
