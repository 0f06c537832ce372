// SPDX-License-Identifier: MIT
// One thread per particle, at the beginning of a step: keeps the particle's sheet awake, or lets it rest.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(binding = 12) uniform samplerBuffer place_texels;

layout(scalar, binding = 13) buffer Speeds
{
    vec4 speeds[]; // velocity of each particle, and the time for which it has been calm in w
};

layout(scalar, binding = 14) buffer Awake
{
    uint awake_in[]; // last step in which a sheet was awake, plus 1; threads of a sheet write equal values
};

layout(binding = 15) uniform samplerBuffer flow_texels;

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

#include "techniques/cloth/solver/cloth_rest.glsl"

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheet_at(sheet_index);
    uint local = own_particle(sheet_of_group[2u * group + 1u]);
    if (local == cloth_no_vertex) {
        return;
    }
    uint particle = sheet.first + local;
    bool is_awoken = is_roused(local, texelFetch(place_texels, int(particle)).xyz, moment.step);
    if (is_awoken) {
        speeds[particle].w = 0.0;
    }
    if (is_awoken || speeds[particle].w < cloth_rest_s) {
        awake_in[sheet_index] = moment.step + 1u;
    }
}
