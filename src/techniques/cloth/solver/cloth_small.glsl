// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SMALL
#define ESTAMPE_CLOTH_SMALL

// One workgroup a sheet of up to 1,024 particles: all steps of a run, with places in shared memory. A thread
// has its particles in slots, one after the other.
//
// Wanted before: const uint most_slots of a thread, and uint slots, those that it has.
// Wanted after: uint local_of_slot(), the particle of the slot that has its turn, beyond the sheet for none;
// void small_step(uint step, uint number), which lets move() take all of them; and what cloth_links.glsl and
// cloth_move.glsl want of places.

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 12) buffer Places
{
    vec4 places[]; // and inverse mass
};

layout(scalar, binding = 13) buffer Speeds
{
    vec4 speeds[]; // and how long each particle has been calm
};

layout(scalar, binding = 14) readonly buffer Pushes
{
    vec4 pushes[]; // and inverse mass times links, which is all that is read here
};

layout(binding = 15) uniform samplerBuffer flow_texels;

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

shared vec4 predicted[2][cloth_small_sheet]; // by turns
uint newest = 0u;
// Of each particle of a thread, in slots:
vec4 froms[most_slots];     // places and inverse masses
vec4 ways[most_slots];      // what pushes it, or how far a hand leads it in a small step; then its shares
vec4 began[most_slots];     // its place, and how long it had been calm
float beyond_m[most_slots]; // how far from there it will hardly go in this step
uvec2 mets[most_slots];     // solids that come near that
uint slot = 0u;             // of the one that has its turn

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
    return uvec4(cloth_no_vertex); // sheets that keep from themselves take the other way
}

uvec2 torn_of(uint local)
{
    return uvec2(0u); // and so do those that may tear
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

// What is written is seen by all, and what was read is free.
void take_turns()
{
    barrier();
    newest = 1u - newest;
}

// What the step begins with, and whether there has to be one: the first particle's share of links, which this
// turn has no use for and is never negative, tells it. There is no shared memory left.
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

// Loops over slots ask at their end whether there is another: processors run one whose condition comes first
// once more than it says.
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
        goes_on = is_awake(step); // else in no later one either
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
