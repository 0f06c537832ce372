// SPDX-License-Identifier: MIT
// One thread per particle: one relaxation of a Verlet step; the last relaxation ends the step. Only links
// move particles. The links have no compliance, and far links push as well as pull. Zanuttini, "Recherches en
// rendu non réaliste temps réel", Université Paris 8, 2008, chapter 7.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = 64) in;

#include "techniques/cloth/solver/cloth_large.glsl"

// Displacement by one link, like link_pull(). Links a knight's move away are omitted.
float relaxed_pull(vec3 towards, float split_masses, float rest_m, bool is_far)
{
    const float knights_share = 0.8;
    float length_m = length(towards);
    float share = (is_far ? 1.0 : cloth_near_share) * knights_share;
    float give = split_masses * (1.0 / (over_relaxation * share));
    return (length_m - rest_m) / (max(length_m, 1e-9) * give);
}

// Sum of the displacements by the links to the 24 neighbours of a particle on the grid.
vec3 relaxed_on_grid(uint local, vec4 own)
{
    ivec2 size = ivec2(sheet.columns, sheet.rows);
    ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
    float columns[5] = there_about(at.x, size.x);
    float rows[5] = there_about(at.y, size.y);
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    vec3 pull = vec3(0.0);
    [[unroll]] for (int y = -2; y <= 2; ++y)
    {
        [[unroll]] for (int x = -2; x <= 2; ++x)
        {
            if (x != 0 || y != 0) {
                float there = columns[2 + x] * rows[2 + y];
                vec4 other = predicted_beside(local, ivec2(x, y), there > 0.0);
                vec3 to_other = other.xyz - own.xyz;
                vec2 rest = vec2(abs(x) * sheet.spacing_x_m, abs(y) * sheet.spacing_y_m);
                bool is_far = max(abs(x), abs(y)) > 1;
                pull += there * whole_link(torn, x, y) *
                        relaxed_pull(to_other, own.w + other.w, length(rest), is_far) * to_other;
            }
        }
    }
    return pull;
}

vec3 relaxed_by_lists(uint local, vec4 own)
{
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    vec3 pull = vec3(0.0);
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 words = link_at(local, k);
        float rest_m = uintBitsToFloat(words.y);
        if (rest_m != 0.0 && !(may_tear && has_bit(torn, k))) {
            vec4 other = predicted_at(words.x);
            vec3 to_other = other.xyz - own.xyz;
            pull += to_other * relaxed_pull(to_other, own.w + other.w, abs(rest_m), rest_m < 0.0);
        }
    }
    return pull;
}

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
    vec4 own = predicted_at(local);
    if (from.w > 0.0) { // a particle without inverse mass is held, and already at its target
        bool is_grid = (variant & cloth_bit_grid) != 0u;
        own.xyz += from.w * (is_grid ? relaxed_on_grid(local, own) : relaxed_by_lists(local, own));
    }
    if ((variant & cloth_bit_last) == 0u) {
        predicted[particle] = own;
        return;
    }
    if (from.w > 0.0) {
        own.xyz = let_to(local, from.xyz, own.xyz, moment.step, 0u);
    }
    vec4 before = began[particle];
    places[particle] = vec4(own.xyz, from.w);
    speeds[particle] = vec4(speed_after(from.xyz, own.xyz), calm_after(before.w, before.xyz, own.xyz));
}
