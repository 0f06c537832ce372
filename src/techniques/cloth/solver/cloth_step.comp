// SPDX-License-Identifier: MIT
// One thread a particle: a small step, or one relaxation of a whole one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/solids/cloth_met.glsl"

layout(scalar, binding = 12) buffer Places
{
    vec4 places[]; // and inverse mass
};

layout(scalar, binding = 13) writeonly buffer Speeds
{
    vec4 speeds[]; // and how long each particle has been calm
};

layout(scalar, binding = 14) readonly buffer Pushes
{
    vec4 pushes[];
};

layout(binding = 15) uniform samplerBuffer predicted_texels;

layout(scalar, binding = 16) writeonly buffer Predicted
{
    vec4 predicted[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

vec4 predicted_at(uint local)
{
    return texelFetch(predicted_texels, int(sheet.first + local));
}

vec4 own_predicted(uint local)
{
    return predicted_at(local);
}

vec4 predicted_beside(uint local, ivec2 way, bool is_there)
{
    return predicted_at(is_there ? uint(int(local) + way.y * int(sheet.columns) + way.x) : local);
}

layout(binding = 17) uniform usamplerBuffer near_texels;

layout(scalar, binding = 18) readonly buffer Awake
{
    uint awake_in[];
};

layout(scalar, binding = 19) readonly buffer Began
{
    vec4 began[];
};

layout(scalar, binding = 20) readonly buffer Met
{
    uint met[]; // of each group: the ball about it, and which solids come near that
};

layout(binding = 21) uniform usamplerBuffer torn_texels;

uvec2 torn_of(uint local)
{
    return texelFetch(torn_texels, int(sheet.first + local)).xy;
}

uvec4 near_of(uint local)
{
    return texelFetch(near_texels, int(sheet.first + local));
}

vec4 met_ball()
{
    uint at = gl_WorkGroupID.x * met_stride();
    return uintBitsToFloat(uvec4(met[at], met[at + 1u], met[at + 2u], met[at + 3u]));
}

uint met_solids(uint word)
{
    return met[gl_WorkGroupID.x * met_stride() + cloth_met_head + word];
}

#include "techniques/cloth/solver/cloth_awake.glsl"
#include "techniques/cloth/solver/cloth_move.glsl"

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    if (!is_awake(sheet_index, moment.step)) {
        return;
    }
    sheet = sheet_at(sheet_index);
    uint local = own_particle(sheet_of_group[2u * group + 1u]);
    if (local == cloth_no_vertex) {
        return;
    }
    uint particle = sheet.first + local;
    vec4 from = places[particle];
    bool is_last = (variant & cloth_bit_last) != 0u;
    if (is_relaxing && !is_last) {
        vec4 own = predicted_at(local);
        own.xyz += from.w > 0.0 ? pull_of(local, own, from.w) : vec3(0.0);
        predicted[particle] = own;
        return;
    }
    vec3 to = moved(local, from.xyz, from.w, moment.step, moment.small_step);
    vec3 speed = speed_after(from.xyz, to);
    places[particle] = vec4(to, from.w);
    if (is_last || (variant & cloth_bit_descent) != 0u) { // which wants to know it in between
        vec4 before = began[particle];
        speeds[particle] = vec4(speed, is_last ? calm_after(before.w, before.xyz, to) : before.w);
    }
    if (is_last) {
        return;
    }
    vec4 push = pushes[particle];
    float next = part_of_run(moment.step, float(moment.small_step + 2u));
    predicted[particle] = vec4(foreseen(local, to, speed, push.xyz, from.w, next), push.w);
}
