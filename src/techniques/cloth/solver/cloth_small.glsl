// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SMALL
#define ESTAMPE_CLOTH_SMALL

// One workgroup per sheet of up to 1,024 particles: all steps of a run, with positions in shared memory. Each
// thread has its particles in slots and processes one slot after another.
//
// Requires before inclusion: the constants `most_slots` (largest number of slots per thread) and `slots`
// (number of slots in use). Requires after inclusion: uint local_of_slot(), the particle of the current slot,
// or an index beyond the sheet; void small_step(uint step, uint number), which calls move() for all slots;
// and the positions that cloth_links.glsl and cloth_move.glsl require.

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 12) buffer Places
{
    vec4 places[]; // position of each particle, and its inverse mass in w
};

layout(scalar, binding = 13) buffer Speeds
{
    vec4 speeds[]; // velocity of each particle, and the time for which it has been calm in w
};

layout(scalar, binding = 14) readonly buffer Pushes
{
    vec4 pushes[]; // w: inverse mass times the shares of the links; xyz is not read here
};

layout(binding = 15) uniform samplerBuffer flow_texels;

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

// Predicted positions: one half of the array is read while the other half is written.
shared vec4 predicted[2][cloth_small_sheet];
uint newest = 0u;
// Data of a thread's particles, by slot:
vec4 froms[most_slots]; // position of the slot's particle, and its inverse mass in w
vec4 ways[most_slots];  // acceleration, or a holder's motion per small step; w: share of links
vec4 began[most_slots]; // position at the step's beginning; w: time for which the particle has been calm
// Distance from `began` that the particle will hardly move beyond in the current step.
float beyond_m[most_slots];
uvec2 mets[most_slots]; // bits of the solids that come near the ball of radius `beyond_m` about `began`
uint slot = 0u;         // slot of the particle that is being processed

vec4 predicted_at(uint local)
{
    return predicted[newest][local];
}

vec3 place_at(uint local)
{
    return predicted[newest][local].xyz;
}

uvec4 near_of(uint local)
{
    return uvec4(cloth_no_vertex); // a shader for small sheets never processes sheets with self-collision
}

uvec2 torn_of(uint local)
{
    return uvec2(0u); // a shader for small sheets never processes sheets that may tear
}

vec4 met_ball()
{
    return vec4(began[slot].xyz, beyond_m[slot]);
}

uint met_solids(uint word)
{
    return word == 0u ? mets[slot].x : word == 1u ? mets[slot].y : ~0u;
}

uint local_of_slot();
void small_step(uint step, uint number);
vec4 own_predicted(uint local);
vec4 predicted_beside(uint local, ivec2 way, bool is_there);

#include "techniques/cloth/air/cloth_air.glsl"
#include "techniques/cloth/solver/cloth_move.glsl"
#include "techniques/cloth/solver/cloth_rest.glsl"

// Makes written positions visible to all threads of the workgroup, and allows overwriting the positions that
// were read.
void take_turns()
{
    barrier();
    newest = 1u - newest;
}

// Loads a particle at the beginning of a step, and marks the sheet as awake if the particle is not at rest.
// The mark is stored in the first particle's share of links, because no shared memory is left. The share is
// never negative and not used here.
void look_at(uint local, uint step)
{
    vec4 place = places[sheet.first + local];
    float calm_s = is_roused(local, place.xyz, step) ? 0.0 : speeds[sheet.first + local].w;
    predicted[1u - newest][local].xyz = place.xyz;
    froms[slot] = place;
    began[slot] = vec4(place.xyz, calm_s);
    if (calm_s < cloth_rest_s) {
        predicted[1u - newest][0].w = -float(step + 1u);
    }
}

// Whether the sheet moves in the current step. Loops over slots test their condition at the end: on CPU
// implementations of Vulkan, a loop that tests its condition at the beginning runs one extra round.
bool is_awake(uint step)
{
    slot = 0u;
    do {
        if (local_of_slot() < sheet.count) {
            look_at(local_of_slot(), step);
        }
        ++slot;
    } while (slot < slots);
    take_turns();
    return predicted[newest][0].w == -float(step + 1u);
}

vec3 way_of_hand(uint local)
{
    return (target_of(local, 1.0) - target_of(local, 0.0)).xyz / float(run.step_count * run.small_steps);
}

void push_off(uint local, uint step)
{
    float time_s = run.time_s + float(step) * run.step_s;
    vec4 place = froms[slot];
    vec3 speed = speeds[sheet.first + local].xyz;
    bool is_held = place.w == 0.0;
    vec3 push = is_held ? way_of_hand(local) : push_on(local, place.xyz, speed, place.w, time_s);
    float split = pushes[sheet.first + local].w;
    ways[slot] = vec4(push, split);
    predicted[1u - newest][local] =
        vec4(foreseen(local, place.xyz, speed, push, place.w, part_of_run(step, 1.0)), split);
    if ((variant & cloth_bit_colliders) != 0u) {
        beyond_m[slot] = hardly_beyond_m(speed, push);
        mets[slot] = uvec2(solids_near(0u, met_ball(), step), solids_near(1u, met_ball(), step));
    }
}

void begin_step(uint step)
{
    slot = 0u;
    do {
        if (local_of_slot() < sheet.count) {
            push_off(local_of_slot(), step);
        }
        ++slot;
    } while (slot < slots);
    take_turns();
}

void move(uint local, uint step, uint number)
{
    uint particle = sheet.first + local;
    vec4 from = froms[slot];
    vec3 to = moved(local, from.xyz, from.w, step, number);
    vec3 speed = speed_after(from.xyz, to);
    vec4 way = ways[slot];
    froms[slot] = vec4(to, from.w);
    if (number + 1u == run.small_steps) {
        vec4 before = began[slot];
        places[particle] = vec4(to, from.w);
        speeds[particle] = vec4(speed, calm_after(before.w, before.xyz, to));
    }
    vec3 next = to + (from.w == 0.0 ? way.xyz : small_step_s() * (speed + small_step_s() * way.xyz));
    predicted[1u - newest][local] = vec4(next, way.w);
}

ClothSheet sheet_of_workgroup()
{
    return sheets[sheet_of_group[moment.first_group + gl_WorkGroupID.x]];
}

void go_all_steps()
{
    if (gl_LocalInvocationID.x == 0u) {
        predicted[1u - newest][0].w = 0.0;
    }
    barrier();
    uint step = 0u;
    bool goes_on = true;
    do {
        goes_on = is_awake(step); // a sheet at rest stays at rest until the run of steps ends
        if (goes_on) {
            begin_step(step);
            uint number = 0u;
            do {
                small_step(step, number);
                ++number;
            } while (number < run.small_steps);
        }
        ++step;
    } while (goes_on && step < run.step_count);
}

#endif
