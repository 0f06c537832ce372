// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_MOVE
#define ESTAMPE_CLOTH_MOVE

// A small step of one particle: corrects its predicted position by links, tethers, holders and solids.
//
// Requires: vec4 own_predicted(uint local), like predicted_at() of cloth_links.glsl; uvec4 near_of(uint
// local).

#include "techniques/cloth/solids/cloth_contact.glsl"
#include "techniques/cloth/solver/cloth_links.glsl"

// Self-collision: a particle moves away from a particle that is too near, by half the missing distance. Only
// the nearest four particles that are not near in the rest shape are tested.
vec3 kept_from_self(uint local, vec3 place)
{
    uvec4 others = near_of(local);
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        bool is_there = others[i] != cloth_no_vertex;
        vec3 off = place - predicted_at(is_there ? others[i] : local).xyz;
        float away_m = length(off);
        if (is_there && away_m > 1e-9 && away_m < sheet.self_m) {
            sum += off * (0.5 * (sheet.self_m - away_m) / away_m);
            count += 1.0;
        }
    }
    return place + sum / max(count, 1.0);
}

// A partly held particle moves towards its target. The strength of the hold is the share of the way to the
// target that the particle moves per sixtieth of a second.
vec3 held_a_little(uint local, vec3 place, float part)
{
    vec4 target = target_of(local, part);
    float left = pow(1.0 - target.w, 60.0 * small_step_s());
    return target.w > 0.0 ? mix(target.xyz, place, left) : place;
}

// Moves a particle from one place to another, as far as self-collision, its holder and solids allow.
vec3 let_to(uint local, vec3 from, vec3 place, uint step, uint small_step)
{
    float part = part_of_run(step, float(small_step + 1u));
    if ((variant & cloth_bit_self) != 0u) {
        place = kept_from_self(local, place);
    }
    if ((variant & cloth_bit_half_held) != 0u) {
        place = held_a_little(local, place, part);
    }
    if ((variant & cloth_bit_colliders) != 0u) {
        place = beside_colliders(from, place, part_of_run(step, float(small_step)), part);
    }
    return place;
}

vec3 moved(uint local, vec3 from, float inverse_mass, uint step, uint small_step)
{
    vec4 own = own_predicted(local);
    vec3 place = own.xyz;
    if (inverse_mass == 0.0) { // the particle is held, and already at its target
        return place;
    }
    if ((variant & cloth_bit_descent) == 0u) {
        place += pull_of(local, own, inverse_mass);
    }
    return let_to(local, from, tethered(local, place), step, small_step);
}

vec3 speed_after(vec3 from, vec3 to)
{
    float time_s = small_step_s();
    vec3 speed = (to - from) * (exp(-sheet.damping_per_s * time_s) / time_s);
    float speed_m_per_s = length(speed);
    return speed_m_per_s > run.most_speed_m_per_s ? speed * (run.most_speed_m_per_s / speed_m_per_s) : speed;
}

// Time for which a particle has been calm, at the end of a step. Whole steps are compared, because the motion
// in one small step is as small as rounding errors.
float calm_after(float calm_s, vec3 began, vec3 ended)
{
    bool is_calm = distance(began, ended) <= run.rest_m_per_s * run.step_s;
    return is_calm ? min(calm_s + run.step_s, cloth_rest_s) : 0.0;
}

#endif
