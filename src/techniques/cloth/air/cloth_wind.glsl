// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_WIND
#define ESTAMPE_CLOTH_WIND

// The open wind (away from fluid simulations), and the force of air on a face. Eddies: Bridson, Hourihan and
// Nordenstam, "Curl-Noise for Procedural Fluid Flow", SIGGRAPH 2007. The curl of a pair of potentials is the
// cross product of their gradients.
//
// Requires: run, sheet and variant of cloth_data.glsl.

#include "shaders/hash.glsl"

float corner_value(ivec3 cell, uint seed)
{
    return 2.0f * unit_float(hash(uint(cell.x) ^ seed, uint(cell.y), uint(cell.z))) - 1.0f;
}

// Noise in [-1, 1] in w, with one bump per unit of length; the gradient of the noise in xyz.
vec4 noise_and_slope(vec3 place, uint seed)
{
    ivec3 cell = ivec3(floor(place));
    vec3 f = place - vec3(cell);
    vec3 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    vec3 du = 30.0f * f * f * (f * (f - 2.0f) + 1.0f);
    vec4 lower;
    vec4 upper;
    for (int i = 0; i < 4; ++i) {
        ivec2 off = ivec2(i & 1, i >> 1);
        lower[i] = corner_value(cell + ivec3(off, 0), seed);
        upper[i] = corner_value(cell + ivec3(off, 1), seed);
    }
    vec4 across = mix(lower, upper, u.z);
    vec2 row = mix(vec2(across.x, across.z), vec2(across.y, across.w), u.x);
    vec2 row_slope = vec2(across.y, across.w) - vec2(across.x, across.z);
    vec4 rise = upper - lower;
    vec2 rise_row = mix(vec2(rise.x, rise.z), vec2(rise.y, rise.w), u.x);
    return vec4(du.x * mix(row_slope.x, row_slope.y, u.y), du.y * (row.y - row.x),
                du.z * mix(rise_row.x, rise_row.y, u.y), mix(row.x, row.y, u.y));
}

// Wind velocity at a place and time. The wind moves its gusts and eddies along; eddies also change shape
// slowly.
vec3 open_wind_at(vec3 place, float time_s)
{
    vec3 wind = run.wind_m_per_s;
    if ((variant & cloth_bit_gusts) == 0u) {
        return wind;
    }
    vec3 blown = place + run.origin_m - time_s * wind - run.ahead_m;
    float speed_m_per_s = length(wind);
    float gust = noise_and_slope(vec3(vec2(blown.x, blown.z) / run.gust_m, 0.2f * time_s), 17u).w;
    vec3 in_eddies = blown / run.eddy_m + vec3(0.0f, 0.35f * time_s, 0.0f);
    vec3 eddy = cross(vec3(noise_and_slope(in_eddies, 31u)), vec3(noise_and_slope(in_eddies, 57u)));
    return wind * (1.0f + run.gustiness * gust) + 0.5f * run.turbulence * speed_m_per_s * eddy;
}

// Force of air on a cloth face with the area vector `area`. `relative` is the air's velocity relative to the
// face. The force is pressure along the face's normal, and lift across the flow.
vec3 force_on(vec3 area, vec3 relative)
{
    float area_m2 = length(area);
    float speed_m_per_s = length(relative);
    if (area_m2 < 1e-12f || speed_m_per_s < 1e-9f) {
        return vec3(0.0f);
    }
    vec3 normal = area / area_m2;
    float across = dot(relative, normal);
    vec3 lift = across * (speed_m_per_s * normal - across * relative / speed_m_per_s);
    return 0.5f * run.air_kg_m3 * area_m2 * (sheet.drag * abs(across) * across * normal + sheet.lift * lift);
}

#endif
