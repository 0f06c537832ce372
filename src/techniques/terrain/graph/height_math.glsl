// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_MATH
#define ESTAMPE_HEIGHT_MATH

// Evaluates the leaves of height graphs: noise, textures, dunes and other functions of the coordinates. For
// GLSL and for C++, where the functions are members of HeightMath and Real is float or double. The including
// file must define Real, Real2 and Real4, and the functions
//
//     Real height_number(uint index)        a parameter of the graph
//     Real height_place(uint index)         a number of the places, sixteen words each, see place_at()
//     int height_cell(uint index)           a whole number of the places
//     Real height_texel(uint index)         a texel of the textures, one after another

#include "shaders/hash.glsl"
#include "techniques/terrain/graph/dual_math.glsl"

// The coordinates of a leaf (such as noise) in its own units: whole cells, and the offset from the whole
// cells in each direction. `period_m` is the length of one unit on the ground.
struct Place {
    int cell_u;
    int cell_v;
    Real4 u;
    Real4 v;
    Real period_m;
};

// Evaluates a curve through `count` points. The points are stored as (x, y, slope) from parameter `first` on.
// Beyond its ends, the curve is level.
Real4 dual_curve(Real4 a, uint first, uint count)
{
    uint last = first + 3u * (count - 1u);
    if (a.x <= height_number(first)) {
        return dual(height_number(first + 1u));
    }
    if (a.x >= height_number(last)) {
        return dual(height_number(last + 1u));
    }
    uint at = first;
    for (uint i = 1u; i + 1u < count; ++i) {
        if (a.x >= height_number(first + 3u * i)) {
            at = first + 3u * i;
        }
    }
    Real width = height_number(at + 3u) - height_number(at);
    Real t = (a.x - height_number(at)) / width;
    Real y0 = height_number(at + 1u);
    Real y1 = height_number(at + 4u);
    Real m0 = height_number(at + 2u) * width;
    Real m1 = height_number(at + 5u) * width;
    Real c2 = Real(3) * (y1 - y0) - Real(2) * m0 - m1;
    Real c3 = Real(2) * (y0 - y1) + m0 + m1;
    return dual_chain(a, y0 + t * (m0 + t * (c2 + t * c3)),
                      (m0 + t * (Real(2) * c2 + t * Real(3) * c3)) / width);
}

// Factor on the amplitude of a feature that repeats every `period_m` metres, for a grid with `spacing_m`
// between vertices. The factor fades out features that are too fine for the grid.
Real share_shown(Real period_m, Real spacing_m)
{
    if (period_m >= Real(4) * spacing_m) {
        return Real(1);
    }
    if (period_m <= Real(2) * spacing_m) {
        return Real(0);
    }
    Real t = period_m / (Real(2) * spacing_m) - Real(1);
    return t * t * (Real(3) - Real(2) * t);
}

Place place_at(uint place, Real x, Real z)
{
    Place p;
    uint first = place * 16u;
    Real ux = height_place(first);
    Real uz = height_place(first + 1u);
    Real vx = height_place(first + 2u);
    Real vz = height_place(first + 3u);
    p.u = Real4(height_place(first + 4u) + (ux * x + uz * z), ux, uz, height_place(first + 6u));
    p.v = Real4(height_place(first + 5u) + (vx * x + vz * z), vx, vz, height_place(first + 7u));
    p.cell_u = height_cell(first + 8u);
    p.cell_v = height_cell(first + 9u);
    p.period_m = height_place(first + 10u);
    return p;
}

// The coordinates of a leaf (such as noise), displaced by the vector (u, v). The displacement is in metres of
// the leaf's coordinate frame.
Place place_warped(uint place, Real x, Real z, Real4 u, Real4 v)
{
    Place p = place_at(place, x, z);
    p.u = p.u + u * height_place(place * 16u + 11u);
    p.v = p.v + v * height_place(place * 16u + 12u);
    return p;
}

// The first coordinate of a frame, in metres.
Real4 coordinate_u(Place p)
{
    Real4 r = p.u;
    r.x = r.x + Real(p.cell_u);
    return r;
}

Real4 coordinate_v(Place p)
{
    Real4 r = p.v;
    r.x = r.x + Real(p.cell_v);
    return r;
}

Real4 leaf_sine(Place p, Real spacing_m)
{
    return dual_sine_of_turns(p.u) * share_shown(p.period_m, spacing_m);
}

uint height_hash(int u, int v, uint seed)
{
    return hash(uint(u), uint(v), seed);
}

Real hashed_unit(uint bits)
{
    return Real(bits >> 8u) * Real(1.0 / 16777216.0);
}

// Converts a whole number to the number of a cell. Warped coordinates may be larger than any integer, or no
// number.
int cell_number(Real whole)
{
    const Real most = Real(1e9);
    return whole > -most ? int(whole < most ? whole : most) : -1000000000;
}

// Gradient noise in about [-1, 1] with one feature per unit (Perlin, "Improving noise", SIGGRAPH 2002, but
// with arbitrary gradients).
Real4 gradient_noise(Place p, uint seed)
{
    Real base_u = real_floor(p.u.x);
    Real base_v = real_floor(p.v.x);
    int cell_u = p.cell_u + cell_number(base_u);
    int cell_v = p.cell_v + cell_number(base_v);
    Real fu = p.u.x - base_u;
    Real fv = p.v.x - base_v;
    Real wu = fu * fu * fu * (fu * (fu * Real(6) - Real(15)) + Real(10));
    Real wv = fv * fv * fv * (fv * (fv * Real(6) - Real(15)) + Real(10));
    Real du = Real(30) * fu * fu * (fu * (fu - Real(2)) + Real(1));
    Real dv = Real(30) * fv * fv * (fv * (fv - Real(2)) + Real(1));
    Real sum = Real(0);
    Real sum_u = Real(0);
    Real sum_v = Real(0);
    for (int corner = 0; corner < 4; ++corner) {
        int iu = corner & 1;
        int iv = corner >> 1;
        uint bits = height_hash(cell_u + iu, cell_v + iv, seed);
        Real gu = Real(bits & 0xffffu) * Real(2.0 / 65535.0) - Real(1);
        Real gv = Real(bits >> 16u) * Real(2.0 / 65535.0) - Real(1);
        Real ramp = gu * (fu - Real(iu)) + gv * (fv - Real(iv));
        Real share_u = iu == 1 ? wu : Real(1) - wu;
        Real share_v = iv == 1 ? wv : Real(1) - wv;
        sum = sum + share_u * share_v * ramp;
        sum_u = sum_u + share_v * (share_u * gu + (iu == 1 ? du : -du) * ramp);
        sum_v = sum_v + share_u * (share_v * gv + (iv == 1 ? dv : -dv) * ramp);
    }
    Real4 r = p.u * (sum_u * Real(1.5)) + p.v * (sum_v * Real(1.5));
    r.x = sum * Real(1.5);
    return r;
}

// Gradient noise. The noise's parameter in the program is the seed.
Real4 leaf_noise(Place p, uint first, Real spacing_m)
{
    return gradient_noise(p, uint(height_number(first))) * share_shown(p.period_m, spacing_m);
}

// The coordinates for the next octave of noise: rotated by 26.6 degrees and scaled by the square root of
// five. The rotation and scaling map cells to cells, so no lattice is visible and no rounding occurs.
Place next_octave(Place p)
{
    Place q;
    q.cell_u = 2 * p.cell_u - p.cell_v;
    q.cell_v = p.cell_u + 2 * p.cell_v;
    q.u = p.u * Real(2) - p.v;
    q.v = p.u + p.v * Real(2);
    Real whole_u = real_floor(q.u.x);
    Real whole_v = real_floor(q.v.x);
    q.cell_u = q.cell_u + cell_number(whole_u);
    q.cell_v = q.cell_v + cell_number(whole_v);
    q.u.x = q.u.x - whole_u;
    q.v.x = q.v.x - whole_v;
    q.period_m = p.period_m * Real(0.4472135954999579);
    return q;
}

// Fractal noise (fbm): a sum of octaves of gradient noise. The noise's parameters in the program are seed,
// octaves, gain.
Real4 leaf_fbm(Place p, uint first, Real spacing_m)
{
    uint seed = uint(height_number(first));
    int octaves = int(height_number(first + 1u));
    Real gain = height_number(first + 2u);
    Real4 sum = dual(Real(0));
    Real weight = Real(1);
    int octave = 0;
    do {
        Real shown = share_shown(p.period_m, spacing_m);
        if (shown > Real(0)) {
            sum = sum + gradient_noise(p, seed + uint(octave)) * (weight * shown);
        }
        weight = weight * gain;
        p = next_octave(p);
    } while (++octave < octaves);
    return sum;
}

// Ridged noise: ridges where gradient noise crosses zero; in [0, 1] for one octave. The noise's parameters in
// the program are seed, octaves, gain.
Real4 leaf_ridged(Place p, uint first, Real spacing_m)
{
    uint seed = uint(height_number(first));
    int octaves = int(height_number(first + 1u));
    Real gain = height_number(first + 2u);
    Real4 sum = dual(Real(0));
    Real weight = Real(1);
    int octave = 0;
    do {
        Real shown = share_shown(p.period_m, spacing_m);
        if (shown > Real(0)) {
            Real4 crest = dual(Real(1)) - dual_abs(gradient_noise(p, seed + uint(octave)));
            sum = sum + dual_mul(crest, crest) * (weight * shown);
        }
        weight = weight * gain;
        p = next_octave(p);
    } while (++octave < octaves);
    return sum;
}

// Cellular noise: distance in cells to the nearest of random points, one per cell (Worley, "A cellular
// texture basis function", SIGGRAPH 1996). The noise's parameter in the program is the seed.
Real4 leaf_cellular(Place p, uint first, Real spacing_m)
{
    uint seed = uint(height_number(first));
    Real base_u = real_floor(p.u.x);
    Real base_v = real_floor(p.v.x);
    Real fu = p.u.x - base_u;
    Real fv = p.v.x - base_v;
    Real nearest = Real(8);
    Real nearest_u = Real(0);
    Real nearest_v = Real(0);
    for (int neighbour = 0; neighbour < 9; ++neighbour) {
        int iu = neighbour % 3 - 1;
        int iv = neighbour / 3 - 1;
        uint bits =
            height_hash(p.cell_u + cell_number(base_u) + iu, p.cell_v + cell_number(base_v) + iv, seed);
        Real du = fu - Real(iu) - hashed_unit(bits);
        Real dv = fv - Real(iv) - hashed_unit(hash(bits));
        Real square = du * du + dv * dv;
        if (square < nearest) {
            nearest = square;
            nearest_u = du;
            nearest_v = dv;
        }
    }
    Real far = sqrt(nearest);
    Real inverse = far > Real(0) ? Real(1) / far : Real(0);
    Real4 r = p.u * (nearest_u * inverse) + p.v * (nearest_v * inverse);
    r.x = far;
    return r * share_shown(p.period_m, spacing_m);
}

// The texel to read for `index` in a row of `count` texels. If `wrap` is 0 the row repeats, if 1 it is
// mirrored, if 2 the index is clamped.
int wrapped_texel(int index, int count, int wrap)
{
    if (wrap == 2) {
        return index < 0 ? 0 : (index >= count ? count - 1 : index);
    }
    int period = wrap == 1 ? 2 * count : count;
    int at = index % period;
    at = at < 0 ? at + period : at;
    return at >= count ? period - 1 - at : at;
}

// Weights of the four texels around a position t, from 0 to 1, between the middle two texels. The weights are
// either linear, or a smooth curve through the texels (Catmull and Rom 1974).
Real4 texel_weights(Real t, bool is_cubic)
{
    if (!is_cubic) {
        return Real4(Real(0), Real(1) - t, t, Real(0));
    }
    return Real4(t * (t * (Real(1) - Real(0.5) * t) - Real(0.5)),
                 t * t * (Real(1.5) * t - Real(2.5)) + Real(1),
                 t * (t * (Real(2) - Real(1.5) * t) + Real(0.5)), t * t * (Real(0.5) * t - Real(0.5)));
}

Real4 texel_slopes(Real t, bool is_cubic)
{
    if (!is_cubic) {
        return Real4(Real(0), Real(-1), Real(1), Real(0));
    }
    return Real4(t * (Real(2) - Real(1.5) * t) - Real(0.5), t * (Real(4.5) * t - Real(5)),
                 t * (Real(4) - Real(4.5) * t) + Real(0.5), t * (Real(1.5) * t - Real(1)));
}

// Height from a texture. The parameters in the program are: first texel, columns, rows, wrap mode, a flag for
// cubic interpolation, and mean height. One unit of the coordinates is the whole texture.
Real4 leaf_texture(Place p, uint first, Real spacing_m)
{
    uint first_texel = uint(height_number(first));
    int columns = int(height_number(first + 1u));
    int rows = int(height_number(first + 2u));
    int wrap = int(height_number(first + 3u));
    bool is_cubic = height_number(first + 4u) > Real(0.5);
    Real mean = height_number(first + 5u);
    // A repeating texture ignores the number of whole textures before the place. The number matters only if
    // the texture is mirrored or clamped.
    int turn_u = wrap == 0 ? 0 : (wrap == 1 ? p.cell_u & 1 : clamp(p.cell_u, -2, 2));
    int turn_v = wrap == 0 ? 0 : (wrap == 1 ? p.cell_v & 1 : clamp(p.cell_v, -2, 2));
    Real u = p.u.x * Real(columns) - Real(0.5);
    Real v = p.v.x * Real(rows) - Real(0.5);
    Real base_u = real_floor(u);
    Real base_v = real_floor(v);
    Real4 weights_u = texel_weights(u - base_u, is_cubic);
    Real4 weights_v = texel_weights(v - base_v, is_cubic);
    Real4 slopes_u = texel_slopes(u - base_u, is_cubic);
    Real4 slopes_v = texel_slopes(v - base_v, is_cubic);
    Real sum = Real(0);
    Real sum_u = Real(0);
    Real sum_v = Real(0);
    for (int j = 0; j < 4; ++j) {
        int row = wrapped_texel(cell_number(base_v) + j - 1 + turn_v * rows, rows, wrap);
        for (int i = 0; i < 4; ++i) {
            int column = wrapped_texel(cell_number(base_u) + i - 1 + turn_u * columns, columns, wrap);
            Real texel = height_texel(first_texel + uint(row * columns + column)) - mean;
            sum = sum + weights_u[i] * weights_v[j] * texel;
            sum_u = sum_u + slopes_u[i] * weights_v[j] * texel;
            sum_v = sum_v + weights_u[i] * slopes_v[j] * texel;
        }
    }
    Real4 r = p.u * (sum_u * Real(columns)) + p.v * (sum_v * Real(rows));
    r.x = sum;
    r = r * share_shown(p.period_m / Real(max(columns, rows)) * Real(2), spacing_m);
    r.x = r.x + mean;
    return r;
}

// One-dimensional noise in [-1, 1], different for each `row`. Returns the noise and its first and second
// derivative.
Real4 row_noise(int cell, Real t, int row, uint seed)
{
    Real base = real_floor(t);
    Real f = t - base;
    int at = cell + cell_number(base);
    Real a = Real(2) * hashed_unit(height_hash(at, row, seed)) - Real(1);
    Real b = Real(2) * hashed_unit(height_hash(at + 1, row, seed)) - Real(1);
    Real weight = f * f * f * (f * (f * Real(6) - Real(15)) + Real(10));
    Real slope = Real(30) * f * f * (f * (f - Real(2)) + Real(1));
    Real bend = Real(60) * f * (f * (Real(2) * f - Real(3)) + Real(1));
    return Real4(a + (b - a) * weight, (b - a) * slope, (b - a) * bend, Real(0));
}

// In front of a dune, the modelled surface falls below the ground. The slope in front of a dune is the slope
// of a dune with at least the share `least_dune` of the usual height.
const Real least_dune = Real(0.25);
const Real before_rise = Real(0.29);

// Height of dune number `row` in a train of dunes. The dune rises over `windward_m` to its brink (sharp upper
// edge), then falls at the angle of repose. Outside of the dune the height is negative, but not below
// -foot_m.
Real4 one_dune(Place p, int row, uint first, Real foot_m, Real spacing_m)
{
    uint seed = uint(height_number(first));
    Real height_m = height_number(first + 1u);
    Real wavelength_m = height_number(first + 2u);
    Real repose = height_number(first + 3u);
    Real windward_m = height_number(first + 4u);
    Real meander = height_number(first + 5u);
    Real variation = height_number(first + 6u);
    Real crest_m = height_number(first + 7u);
    int ridge = p.cell_u + row;
    // Position of the brink (the sharp upper edge), in wavelengths, and the height of the brink.
    Real4 shift = row_noise(p.cell_v, p.v.x, ridge, seed) * meander;
    Real4 brink = dual_chain(p.v, Real(row) + shift.x, shift.y);
    Real4 behind_m = (p.u - brink) * wavelength_m;
    // Where the brink (sharp upper edge) meanders, the brink's nearest point is closer than the point
    // straight along the wind.
    Real tilt = shift.y * wavelength_m / crest_m;
    Real stretch = sqrt(Real(1) + tilt * tilt);
    Real highest_m = height_m * (Real(1) + Real(0.6) * variation);
    if (behind_m.x <= -windward_m * (Real(1) + before_rise) ||
        behind_m.x * repose >= (highest_m + foot_m) * stretch) {
        return dual(-foot_m);
    }
    Real4 spread = row_noise(p.cell_v, p.v.x, ridge, seed + 1u);
    Real4 crest = dual_chain(p.v, height_m * (Real(1) + variation * (spread.x - Real(0.4))),
                             height_m * variation * spread.y);
    Real tilt_slope = shift.z * wavelength_m / crest_m;
    Real4 straight = dual_chain(p.v, Real(1) / stretch, -tilt * tilt_slope / (stretch * stretch * stretch));
    Real4 lee = crest - dual_mul(behind_m, straight) * repose;
    Real4 climb = dual(Real(1)) + behind_m * (Real(1) / windward_m);
    // The windward slope is level at the foot, steepest in the middle, and still rises at the brink. In front
    // of the foot, the surface is below the ground.
    Real4 rise = dual_chain(climb, climb.x * climb.x * (Real(2.4) - Real(1.4) * climb.x),
                            climb.x * (Real(4.8) - Real(4.2) * climb.x));
    if (climb.x <= Real(0)) {
        rise = dual_chain(climb, Real(-2.4) * climb.x * climb.x, Real(-4.8) * climb.x);
        crest = dual_max(crest, dual(least_dune * height_m));
    }
    if (climb.x >= Real(1)) {
        rise = dual(Real(1));
    }
    // A mesh would show a sharp brink (upper edge of a dune) as a jagged line. So the brink is rounded by the
    // spacing of the mesh's grid.
    return -dual_smooth_max(-dual_mul(crest, rise), -lee, Real(1.5) * repose * spacing_m + Real(1e-9));
}

// Height of dunes. The parameters in the program are: seed, height, wavelength, slope of the slip face (steep
// lee side), length of the rise, meander in wavelengths, variation of height, length of a bend of the crest,
// width of the rounded foot. One unit of the coordinate u is a wavelength downwind, one unit of the
// coordinate v is a bend of the crest.
Real4 leaf_dunes(Place p, uint first, Real spacing_m)
{
    Real shown = share_shown(p.period_m * Real(0.5), spacing_m);
    if (shown <= Real(0)) {
        return dual(Real(0));
    }
    Real whole = real_floor(p.u.x);
    p.cell_u = p.cell_u + cell_number(whole);
    p.u.x = p.u.x - whole;
    Real foot_m = height_number(first + 8u);
    Real4 height = dual(Real(0));
    // Evaluates only dunes whose slip face (steep lee side) or windward rise can reach the place.
    Real lee = height_number(first + 1u) * (Real(1) + Real(0.6) * height_number(first + 6u)) /
               (height_number(first + 3u) * height_number(first + 2u));
    Real meander = height_number(first + 5u);
    int first_row = -int(real_floor(lee + meander));
    Real reach_m = height_number(first + 4u) * (Real(1) + before_rise);
    int last_row = int(real_floor(Real(1) + reach_m / height_number(first + 2u) + meander));
    int row = first_row;
    do {
        height = dual_smooth_max(height, one_dune(p, row, first, foot_m, spacing_m), foot_m);
    } while (++row <= last_row);
    return height * shown;
}

#endif
