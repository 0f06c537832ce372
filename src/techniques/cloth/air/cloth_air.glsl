// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_AIR
#define ESTAMPE_CLOTH_AIR

// Velocity of the air at a particle, and the force of air on a sheet.
//
// Requires: vec3 place_at(uint local), and everything that cloth_flow.glsl and cloth_torn.glsl require.

#include "techniques/cloth/air/cloth_flow.glsl"
#include "techniques/cloth/solver/cloth_torn.glsl"
#include "techniques/cloth/air/cloth_wind.glsl"

vec3 wind_at(vec3 place, float time_s)
{
    vec3 wind = open_wind_at(place, time_s);
    return (variant & cloth_bit_flow) != 0u ? in_flows(place, wind) : wind;
}

vec3 grid_place(ivec2 at, ivec2 size)
{
    ivec2 there = clamp(at, ivec2(0), size - 1);
    return place_at(uint(there.y * size.x + there.x));
}

// Force of the air on a particle: the sum of the particle's shares of the forces on the faces around the
// particle. Air passes through torn faces.
vec3 air_force(uint local, vec3 place, vec3 relative)
{
    vec3 force = vec3(0.0);
    if ((variant & cloth_bit_grid) != 0u) {
        ivec2 size = ivec2(sheet.columns, sheet.rows);
        ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
        uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
        for (int i = 0; i < 4; ++i) {
            ivec2 way = ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
            if (may_tear && has_bit(torn, cell_bit(way))) {
                continue;
            }
            // Beyond the sheet's edge, all corners of a face coincide, so the face has no area and no force.
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
        force += is_torn_face(local, others) ? vec3(0.0) : force_on(area, relative);
    }
    return force;
}

// Acceleration of a particle by gravity and air. In one step, air can at most stop a particle relative to the
// air.
vec3 push_on(uint local, vec3 place, vec3 speed, float inverse_mass, float time_s)
{
    vec3 relative = wind_at(place, time_s) - speed;
    vec3 push = inverse_mass * air_force(local, place, relative);
    float gain = length(push) * run.step_s;
    float most = length(relative);
    return run.gravity_m_s2 + (gain > most ? push * (most / gain) : push);
}

#endif
