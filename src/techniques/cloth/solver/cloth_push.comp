// SPDX-License-Identifier: MIT
// One thread per particle, at the beginning of a step: the acceleration, and the first predicted position.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

// Position of each particle, and its inverse mass in w.
layout(binding = 12) uniform samplerBuffer place_texels;

layout(scalar, binding = 13) readonly buffer Speeds
{
    vec4 speeds[];
};

layout(scalar, binding = 14) buffer Pushes
{
    vec4 pushes[]; // acceleration of each particle; w: inverse mass times the shares of its links
};

layout(scalar, binding = 15) writeonly buffer Predicted
{
    vec4 predicted[];
};

layout(scalar, binding = 16) readonly buffer Awake
{
    uint awake_in[];
};

layout(scalar, binding = 17) writeonly buffer Began
{
    vec4 began[]; // position at the step's beginning; w: time for which the particle has been calm
};

layout(binding = 18) uniform samplerBuffer flow_texels;

layout(scalar, binding = 19) writeonly buffer Met
{
    uint met[]; // per workgroup: its bounding ball, and the bits of solids near the ball
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

layout(binding = 20) uniform usamplerBuffer torn_texels;

uvec2 torn_of(uint local)
{
    return texelFetch(torn_texels, int(sheet.first + local)).xy;
}

vec3 place_at(uint local)
{
    return texelFetch(place_texels, int(sheet.first + local)).xyz;
}

#include "techniques/cloth/air/cloth_air.glsl"
#include "techniques/cloth/solver/cloth_awake.glsl"
#include "techniques/cloth/solids/cloth_met.glsl"

shared uint farthest; // largest distance in the group, as the bits of a float
shared uint near_solids[cloth_met_words];

uint middle_of_group(uint first)
{
    if ((variant & cloth_bit_grid) == 0u) {
        return min(first + cloth_group / 2u, sheet.count - 1u);
    }
    uvec2 size = uvec2(sheet.columns, sheet.rows);
    uvec2 at = min(uvec2(first % size.x, first / size.x) + cloth_tile_side / 2u, size - 1u);
    return at.y * size.x + at.x;
}

// Finds the solids that the group's particles may meet in the current step. All threads of the group must
// call find_solids(). `beyond_m` is the distance that a particle will hardly move beyond.
void find_solids(uint first, uint local, float beyond_m)
{
    uint thread = gl_LocalInvocationID.x;
    if (thread < cloth_met_words) {
        near_solids[thread] = 0u;
    }
    if (thread == 0u) {
        farthest = 0u;
    }
    barrier();
    vec3 middle = place_at(middle_of_group(first));
    if (local != cloth_no_vertex) {
        atomicMax(farthest, floatBitsToUint(distance(middle, place_at(local)) + beyond_m));
    }
    barrier();
    vec4 ball = vec4(middle, uintBitsToFloat(farthest));
    for (uint i = thread; i < min(run.collider_count, 32u * cloth_met_words); i += cloth_group) {
        if (comes_near(i, ball, moment.step)) {
            atomicOr(near_solids[i / 32u], 1u << (i % 32u));
        }
    }
    barrier();
    if (thread < met_stride()) {
        bool is_head = thread < cloth_met_head;
        met[gl_WorkGroupID.x * met_stride() + thread] =
            is_head ? floatBitsToUint(ball[min(thread, 3u)])
                    : near_solids[max(thread, cloth_met_head) - cloth_met_head];
    }
}

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    if (!is_awake(sheet_index, moment.step)) {
        return;
    }
    sheet = sheet_at(sheet_index);
    uint first = sheet_of_group[2u * group + 1u];
    uint local = own_particle(first);
    float beyond_m = 0.0;
    if (local != cloth_no_vertex) {
        uint particle = sheet.first + local;
        vec4 place = texelFetch(place_texels, int(particle));
        vec3 speed = speeds[particle].xyz;
        bool is_roused = (variant & cloth_bit_roused) != 0u;
        began[particle] = vec4(place.xyz, is_roused ? 0.0 : speeds[particle].w);
        float time_s = run.time_s + float(moment.step) * run.step_s;
        vec3 push = place.w == 0.0 ? vec3(0.0) : push_on(local, place.xyz, speed, place.w, time_s);
        float split = pushes[particle].w;
        pushes[particle] = vec4(push, split);
        predicted[particle] =
            vec4(foreseen(local, place.xyz, speed, push, place.w, part_of_run(moment.step, 1.0)), split);
        beyond_m = hardly_beyond_m(speed, push);
    }
    if ((variant & cloth_bit_colliders) != 0u) {
        find_solids(first, local, beyond_m);
    }
}
