// SPDX-License-Identifier: MIT
// One thread a particle: a small step, or one relaxation of a whole one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 10) buffer Places
{
    vec4 places[]; // and inverse mass
};

layout(scalar, binding = 11) writeonly buffer Speeds
{
    vec4 speeds[];
};

layout(scalar, binding = 12) readonly buffer Pushes
{
    vec4 pushes[];
};

layout(binding = 13) uniform samplerBuffer predicted_texels;

layout(scalar, binding = 14) writeonly buffer Predicted
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

layout(binding = 15) uniform usamplerBuffer near_texels;

uvec4 near_of(uint local)
{
    return texelFetch(near_texels, int(sheet.first + local));
}

#include "techniques/cloth/cloth_move.glsl"

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    sheet = sheets[sheet_of_group[2u * group]];
    uint local = sheet_of_group[2u * group + 1u] + gl_LocalInvocationID.x;
    if (local >= sheet.count) {
        return;
    }
    uint particle = sheet.first + local;
    vec4 from = places[particle];
    bool is_last = (variant & cloth_bit_last) != 0u;
    if (is_relaxing && !is_last) {
        vec4 own = predicted_at(local);
        own.xyz += pull_of(local, own, from.w);
        predicted[particle] = own;
        return;
    }
    vec3 to = moved(local, from.xyz, from.w, moment.step, moment.small_step);
    vec3 speed = speed_after(from.xyz, to);
    places[particle] = vec4(to, from.w);
    if (is_last || (variant & cloth_bit_descent) != 0u) { // which wants to know it in between
        speeds[particle] = vec4(speed, 0.0);
    }
    if (is_last) {
        return;
    }
    vec4 push = pushes[particle];
    float next = part_of_run(moment.step, float(moment.small_step + 2u));
    predicted[particle] = vec4(foreseen(local, to, speed, push.xyz, from.w, next), push.w);
}
