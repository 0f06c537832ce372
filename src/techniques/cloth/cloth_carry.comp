// SPDX-License-Identifier: MIT
// One thread per particle: puts the particle at its target, at rest with no link torn, or moves it with its
// sheet.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 12) buffer Places
{
    vec4 places[];
};

layout(scalar, binding = 13) buffer Speeds
{
    vec4 speeds[];
};

layout(scalar, binding = 14) readonly buffer Carries
{
    mat4 carries[]; // matrix that moves a sheet, one per sheet; all zeros resets the sheet
};

layout(scalar, binding = 15) writeonly buffer Torn
{
    uvec2 torn_links[]; // torn bits per particle, see cloth_torn.glsl
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheets[sheet_index];
    uint local = sheet_of_group[2u * group + 1u] + gl_LocalInvocationID.x;
    if (local >= sheet.count) {
        return;
    }
    uint particle = sheet.first + local;
    vec4 place = places[particle];
    mat4 carry = carries[sheet_index];
    if (carry[3][3] == 0.0) {
        places[particle] = vec4(target_of(local, 1.0).xyz, place.w);
        speeds[particle] = vec4(0.0);
        if (sheet.tear > 0.0) {
            torn_links[particle] = uvec2(0u);
        }
    } else {
        places[particle] = vec4((carry * vec4(place.xyz, 1.0)).xyz, place.w);
        speeds[particle] = vec4(mat3(carry) * speeds[particle].xyz, 0.0);
    }
}
