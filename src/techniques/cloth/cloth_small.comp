// SPDX-License-Identifier: MIT
// One workgroup a sheet of up to 1,024 particles: all steps of a run, with places in shared memory.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 256) in;

#extension GL_EXT_control_flow_attributes : require

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
vec4 froms[cloth_small_share]; // places and inverse masses
vec4 ways[cloth_small_share];  // what pushes it, or how far a hand leads it in a small step; then its shares
vec4 began[cloth_small_share]; // its place, and how long it had been calm
vec4 balls[cloth_small_share]; // what it will hardly leave in this step
uvec2 mets[cloth_small_share]; // solids that come near that
uint slot = 0u;                // of the one that has its turn
uint slots = 0u;

// Of a grid a thread has a piece of a column, and rows go through this: what is predicted of a particle and
// of two more each way. So each is read once for two or three particles.
const bool goes_by_rows = (variant & cloth_bit_grid) != 0u;
vec4 window[25];

vec4 predicted_at(uint local)
{
    return predicted[newest][local];
}

vec4 predicted_beside(uint local, ivec2 way, bool is_there)
{
    if (goes_by_rows) {
        return window[12 + 5 * way.y + way.x];
    }
    return predicted_at(is_there ? uint(int(local) + way.y * int(sheet.columns) + way.x) : local);
}

vec4 own_predicted(uint local)
{
    return goes_by_rows ? window[12] : predicted_at(local);
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
    return balls[slot];
}

uint met_solids(uint word)
{
    return word < 2u ? mets[slot][word] : ~0u;
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

// Loops over slots ask at their end whether there is another: processors run one whose condition comes first
// once more than it says.
uint strips_of(uint share)
{
    return sheet.columns * ((sheet.rows + share - 1u) / share);
}

uint slots_of_thread()
{
    uint share = (sheet.count + cloth_small_group - 1u) / cloth_small_group;
    if (goes_by_rows) {
        while (strips_of(share) > cloth_small_group) {
            ++share;
        }
    }
    return share;
}

ivec2 at_of_slot()
{
    uint thread = gl_LocalInvocationID.x;
    return ivec2(thread % sheet.columns, thread / sheet.columns * slots + slot);
}

uint local_of_slot()
{
    if (!goes_by_rows) {
        return gl_LocalInvocationID.x + slot * cloth_small_group;
    }
    ivec2 at = at_of_slot();
    return at.y < int(sheet.rows) ? uint(at.y) * sheet.columns + uint(at.x) : cloth_no_vertex;
}

void read_row(ivec2 at, int row)
{
    int y = clamp(at.y + row - 2, 0, int(sheet.rows) - 1) * int(sheet.columns);
    [[unroll]] for (int x = 0; x < 5; ++x)
    {
        window[5 * row + x] = predicted_at(uint(y + clamp(at.x + x - 2, 0, int(sheet.columns) - 1)));
    }
}

void go_on_to_next_row()
{
    [[unroll]] for (int i = 0; i < 20; ++i)
    {
        window[i] = window[i + 5];
    }
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
    uint particle = sheet.first + local;
    vec4 place = froms[slot];
    vec3 speed = speeds[particle].xyz;
    bool is_held = place.w == 0.0;
    vec3 push = is_held ? way_of_hand(local) : push_on(local, place.xyz, speed, place.w, time_s);
    float split = pushes[particle].w;
    ways[slot] = vec4(push, split);
    predicted[1u - newest][local] =
        vec4(foreseen(local, place.xyz, speed, push, place.w, part_of_run(step, 1.0)), split);
    if ((variant & cloth_bit_colliders) != 0u) {
        balls[slot] = vec4(place.xyz, hardly_beyond_m(speed, push));
        mets[slot] = uvec2(solids_near(0u, balls[slot], step), solids_near(1u, balls[slot], step));
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

void small_step(uint step, uint number)
{
    slot = 0u;
    if (goes_by_rows) {
        [[unroll]] for (int row = 0; row < 4; ++row)
        {
            read_row(at_of_slot(), row);
        }
    }
    do {
        if (goes_by_rows) {
            read_row(at_of_slot(), 4);
        }
        if (local_of_slot() < sheet.count) {
            move(local_of_slot(), step, number);
        }
        if (goes_by_rows) {
            go_on_to_next_row();
        }
        ++slot;
    } while (slot < slots);
    take_turns();
}

void main()
{
    sheet = sheets[sheet_of_group[moment.first_group + gl_WorkGroupID.x]];
    slots = slots_of_thread();
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
