// SPDX-License-Identifier: MIT
// One thread a particle, at the beginning of a step: what pushes it, and where it goes first.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(binding = 10) uniform samplerBuffer place_texels; // and inverse mass

layout(scalar, binding = 11) readonly buffer Speeds
{
    vec4 speeds[];
};

layout(scalar, binding = 12) buffer Pushes
{
    vec4 pushes[]; // and inverse mass times links
};

layout(scalar, binding = 13) writeonly buffer Predicted
{
    vec4 predicted[];
};

layout(scalar, binding = 14) readonly buffer Awake
{
    uint awake_in[];
};

layout(scalar, binding = 15) writeonly buffer Began
{
    vec4 began[]; // places, and how long each had been calm
};

layout(binding = 16) uniform samplerBuffer flow_texels;

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

vec3 place_at(uint local)
{
    return texelFetch(place_texels, int(sheet.first + local)).xyz;
}

#include "techniques/cloth/cloth_air.glsl"

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheets[sheet_index];
    uint local = sheet_of_group[2u * group + 1u] + gl_LocalInvocationID.x;
    if (local >= sheet.count || awake_in[sheet_index] != moment.step + 1u) {
        return;
    }
    uint particle = sheet.first + local;
    vec4 place = texelFetch(place_texels, int(particle));
    vec3 speed = speeds[particle].xyz;
    began[particle] = vec4(place.xyz, speeds[particle].w);
    float time_s = run.time_s + float(moment.step) * run.step_s;
    vec3 push = place.w == 0.0 ? vec3(0.0) : push_on(local, place.xyz, speed, place.w, time_s);
    float split = pushes[particle].w;
    pushes[particle] = vec4(push, split);
    predicted[particle] =
        vec4(foreseen(local, place.xyz, speed, push, place.w, part_of_run(moment.step, 1.0)), split);
}
