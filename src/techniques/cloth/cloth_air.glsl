// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_AIR
#define ESTAMPE_CLOTH_AIR

// The wind, and what it does to a sheet. Eddies: Bridson, Hourihan and Nordenstam, "Curl-Noise for Procedural
// Fluid Flow", SIGGRAPH 2007, with the curl of a pair of potentials as the cross product of their slopes.
//
// Wanted before: vec3 place_at(uint local), and what cloth_flow.glsl wants.

#include "shaders/hash.glsl"
#include "techniques/cloth/cloth_flow.glsl"

float corner_value(ivec3 cell, uint seed)
{
    return 2.0 * unit_float(hash(uint(cell.x) ^ seed, uint(cell.y), uint(cell.z))) - 1.0;
}

// Noise in [-1, 1], one feature a unit, in w; its slope in xyz.
vec4 noise_and_slope(vec3 place, uint seed)
{
    ivec3 cell = ivec3(floor(place));
    vec3 f = place - vec3(cell);
    vec3 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec3 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    vec4 lower;
    vec4 upper;
    for (int i = 0; i < 4; ++i) {
        ivec2 off = ivec2(i & 1, i >> 1);
        lower[i] = corner_value(cell + ivec3(off, 0), seed);
        upper[i] = corner_value(cell + ivec3(off, 1), seed);
    }
    vec4 across = mix(lower, upper, u.z);
    vec2 row = mix(across.xz, across.yw, u.x);
    vec2 row_slope = across.yw - across.xz;
    vec4 rise = upper - lower;
    vec2 rise_row = mix(rise.xz, rise.yw, u.x);
    return vec4(du.x * mix(row_slope.x, row_slope.y, u.y), du.y * (row.y - row.x),
                du.z * mix(rise_row.x, rise_row.y, u.y), mix(row.x, row.y, u.y));
}

// Gusts go with the wind, and eddies go with it and turn over slowly.
vec3 open_wind_at(vec3 place, float time_s)
{
    vec3 wind = run.wind_m_s;
    if ((variant & cloth_bit_gusts) == 0u) {
        return wind;
    }
    vec3 blown = place + run.origin_m - time_s * wind - run.ahead_m;
    float speed_m_s = length(wind);
    float gust = noise_and_slope(vec3(blown.xz / run.gust_m, 0.2 * time_s), 17u).w;
    vec3 in_eddies = blown / run.eddy_m + vec3(0.0, 0.35 * time_s, 0.0);
    vec3 eddy = cross(noise_and_slope(in_eddies, 31u).xyz, noise_and_slope(in_eddies, 57u).xyz);
    return wind * (1.0 + run.gustiness * gust) + 0.5 * run.turbulence * speed_m_s * eddy;
}

vec3 wind_at(vec3 place, float time_s)
{
    vec3 wind = open_wind_at(place, time_s);
    return (variant & cloth_bit_flow) != 0u ? in_flows(place, wind) : wind;
}

// On a face of the area vector `area`, by air that comes with `relative`: pressure along its normal, and lift
// across the flow.
vec3 force_on(vec3 area, vec3 relative)
{
    float area_m2 = length(area);
    float speed_m_s = length(relative);
    if (area_m2 < 1e-12 || speed_m_s < 1e-9) {
        return vec3(0.0);
    }
    vec3 normal = area / area_m2;
    float across = dot(relative, normal);
    vec3 lift = across * (speed_m_s * normal - across * relative / speed_m_s);
    return 0.5 * run.air_kg_m3 * area_m2 * (sheet.drag * abs(across) * across * normal + sheet.lift * lift);
}

vec3 grid_place(ivec2 at, ivec2 size)
{
    ivec2 there = clamp(at, ivec2(0), size - 1);
    return place_at(uint(there.y * size.x + there.x));
}

// By the faces about a particle, of each the share that is its own.
vec3 air_force(uint local, vec3 place, vec3 relative)
{
    vec3 force = vec3(0.0);
    if ((variant & cloth_bit_grid) != 0u) {
        ivec2 size = ivec2(sheet.columns, sheet.rows);
        ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
        for (int i = 0; i < 4; ++i) {
            ivec2 way = ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
            // Beyond the edge all of it falls together and has no area.
            vec3 x = grid_place(at + ivec2(way.x, 0), size);
            vec3 y = grid_place(at + ivec2(0, way.y), size);
            vec3 far = grid_place(at + way, size);
            force += force_on(0.125 * cross(far - place, y - x), relative);
        }
        return force;
    }
    for (uint k = 0u; k < sheet.face_width; ++k) {
        uvec2 others = texelFetch(face_texels, int(sheet.first_face + k * sheet.stride + local)).xy;
        vec3 area = cross(place_at(others.x) - place, place_at(others.y) - place) / 6.0;
        force += force_on(area, relative);
    }
    return force;
}

// Acceleration by gravity and air. Air never does more than stop a particle against it in one step.
vec3 push_on(uint local, vec3 place, vec3 speed, float inverse_mass, float time_s)
{
    vec3 relative = wind_at(place, time_s) - speed;
    vec3 push = inverse_mass * air_force(local, place, relative);
    float gain = length(push) * run.step_s;
    float most = length(relative);
    return run.gravity_m_s2 + (gain > most ? push * (most / gain) : push);
}

#endif
