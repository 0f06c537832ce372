// SPDX-License-Identifier: MIT
// One workgroup a sheet of up to 1,024 particles: all steps of a run, with places in shared memory.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 256) in;

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 10) buffer Places
{
    vec4 places[]; // and inverse mass
};

layout(scalar, binding = 11) buffer Speeds
{
    vec4 speeds[]; // and how long each particle has been calm
};

layout(scalar, binding = 12) buffer Pushes
{
    vec4 pushes[];
};

layout(binding = 13) uniform samplerBuffer flow_texels;

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

shared vec4 predicted[2][cloth_small_group * cloth_small_share]; // by turns
uint newest = 0u;
vec4 began[cloth_small_share]; // places, and how long each had been calm

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

#include "techniques/cloth/cloth_air.glsl"
#include "techniques/cloth/cloth_move.glsl"
#include "techniques/cloth/cloth_rest.glsl"

// What is written is seen by all, and what was read is free.
void take_turns()
{
    barrier();
    newest = 1u - newest;
}

// What the step begins with, and whether there has to be one: the first particle's share of links, which this
// turn has no use for and is never negative, tells it. There is no shared memory left.
bool is_awake(uint step)
{
    for (uint local = gl_LocalInvocationID.x; local < sheet.count; local += cloth_small_group) {
        vec4 place = places[sheet.first + local];
        float calm_s = is_roused(local, place.xyz, step) ? 0.0 : speeds[sheet.first + local].w;
        predicted[1u - newest][local].xyz = place.xyz;
        began[local / cloth_small_group] = vec4(place.xyz, calm_s);
        if (calm_s < cloth_rest_s) {
            predicted[1u - newest][0].w = -float(step + 1u);
        }
    }
    take_turns();
    return predicted[newest][0].w == -float(step + 1u);
}

void begin_step(uint step)
{
    float time_s = run.time_s + float(step) * run.step_s;
    for (uint local = gl_LocalInvocationID.x; local < sheet.count; local += cloth_small_group) {
        uint particle = sheet.first + local;
        vec4 place = places[particle];
        vec3 speed = speeds[particle].xyz;
        vec3 push = place.w == 0.0 ? vec3(0.0) : push_on(local, place.xyz, speed, place.w, time_s);
        float split = pushes[particle].w;
        pushes[particle] = vec4(push, split);
        predicted[1u - newest][local] =
            vec4(foreseen(local, place.xyz, speed, push, place.w, part_of_run(step, 1.0)), split);
    }
    take_turns();
}

void small_step(uint step, uint number)
{
    float next = part_of_run(step, float(number + 2u));
    for (uint local = gl_LocalInvocationID.x; local < sheet.count; local += cloth_small_group) {
        uint particle = sheet.first + local;
        vec4 from = places[particle];
        vec3 to = moved(local, from.xyz, from.w, step, number);
        vec3 speed = speed_after(from.xyz, to);
        vec4 push = pushes[particle];
        vec4 before = began[local / cloth_small_group];
        bool is_last = number + 1u == run.small_steps;
        places[particle] = vec4(to, from.w);
        speeds[particle] = vec4(speed, is_last ? calm_after(before.w, before.xyz, to) : before.w);
        predicted[1u - newest][local] = vec4(foreseen(local, to, speed, push.xyz, from.w, next), push.w);
    }
    take_turns();
}

void main()
{
    sheet = sheets[sheet_of_group[moment.first_group + gl_WorkGroupID.x]];
    if (gl_LocalInvocationID.x == 0u) {
        predicted[1u - newest][0].w = 0.0;
    }
    barrier();
    for (uint step = 0u; step < run.step_count; ++step) {
        if (!is_awake(step)) { // nor in any later one
            break;
        }
        begin_step(step);
        for (uint i = 0u; i < run.small_steps; ++i) {
            small_step(step, i);
        }
    }
}
