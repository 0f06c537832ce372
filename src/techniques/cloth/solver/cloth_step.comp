// SPDX-License-Identifier: MIT
// One thread per particle of a cloth sheet: one small step.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/solver/cloth_large.glsl"

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
    vec3 to = moved(local, from.xyz, from.w, moment.step, moment.small_step);
    vec3 speed = speed_after(from.xyz, to);
    places[particle] = vec4(to, from.w);
    // The cloth solver that uses block descent reads the velocity after every small step.
    if (is_last || (variant & cloth_bit_descent) != 0u) {
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
