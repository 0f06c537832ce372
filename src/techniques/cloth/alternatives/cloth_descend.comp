// SPDX-License-Identifier: MIT
// One thread per particle of one colour (a set of particles without links between them): moves the particle
// to the least energy while all other particles are fixed. Chen, Liu, Yang and Yuksel, "Vertex Block
// Descent", SIGGRAPH 2024.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(scalar, binding = 12) readonly buffer Places
{
    vec4 places[]; // position of each particle, and its inverse mass in w
};

layout(scalar, binding = 13) readonly buffer Speeds
{
    vec4 speeds[];
};

layout(scalar, binding = 14) readonly buffer Pushes
{
    vec4 pushes[];
};

layout(scalar, binding = 15) buffer Predicted
{
    vec4 predicted[];
};

// Particle numbers by colour (a set of particles without links between them); each colour is padded to whole
// workgroups.
layout(binding = 16) uniform usamplerBuffer particle_texels;

layout(scalar, binding = 17) readonly buffer Awake
{
    uint awake_in[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

vec4 predicted_at(uint local)
{
    return predicted[sheet.first + local];
}

layout(binding = 18) uniform usamplerBuffer torn_texels;

uvec2 torn_of(uint local)
{
    return texelFetch(torn_texels, int(sheet.first + local)).xy;
}

#include "techniques/cloth/solver/cloth_awake.glsl"
#include "techniques/cloth/solver/cloth_tethers.glsl"

vec3 force = vec3(0.0);
mat3 hessian = mat3(0.0);

// Adds force and stiffness of one link, like link_pull() but with the link's whole stiffness. For compressed
// springs, the terms that would make the matrix indefinite are omitted.
void add_link(vec3 towards, float rest_m, bool is_far, float compliance_m_n, float most_n_m)
{
    float length_m = max(length(towards), 1e-9);
    bool is_folded = is_far && length_m < sheet.fold * rest_m;
    float wanted_m = is_folded ? sheet.fold * rest_m : rest_m;
    float stiffness_n_m = min(1.0 / max(compliance_m_n, 1e-12), most_n_m);
    stiffness_n_m = is_far && !is_folded && length_m < rest_m ? 0.0 : stiffness_n_m;
    vec3 way = towards / length_m;
    float round_share = max(1.0 - wanted_m / length_m, 0.0);
    force += (stiffness_n_m * (length_m - wanted_m)) * way;
    hessian += stiffness_n_m * ((1.0 - round_share) * outerProduct(way, way) + round_share * mat3(1.0));
}

void add_links_of_grid(uint local, vec3 own, float most_n_m)
{
    ivec2 size = ivec2(sheet.columns, sheet.rows);
    ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
    float columns[5] = there_about(at.x, size.x);
    float rows[5] = there_about(at.y, size.y);
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    vec3 bend = vec3(0.0);
    [[unroll]] for (int y = -2; y <= 2; ++y)
    {
        [[unroll]] for (int x = -2; x <= 2; ++x)
        {
            ivec2 there = at + ivec2(x, y);
            if (abs(x) * abs(y) != 2 && (x != 0 || y != 0) && columns[2 + x] * rows[2 + y] > 0.0) {
                vec3 towards = predicted_at(uint(there.y * size.x + there.x)).xyz - own;
                vec2 rest = vec2(abs(x) * sheet.spacing_x_m, abs(y) * sheet.spacing_y_m);
                if (whole_link(torn, x, y) > 0.0) {
                    add_link(towards, length(rest), max(abs(x), abs(y)) > 1, sheet.softness * dot(rest, rest),
                             most_n_m);
                }
                bend += (may_tear ? torn_bend_share(x, y, columns, rows, torn)
                                  : grid_bend_share(x, y, columns, rows)) *
                        towards;
            }
        }
    }
    force += sheet.bending_n_m * bend;
    hessian += mat3(sheet.bending_n_m * grid_bend_own(at, size));
}

void add_links_of_lists(uint local, vec3 own, float most_n_m)
{
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    float bending_own = 0.0;
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 words = link_at(local, k);
        vec3 link = uintBitsToFloat(words.yzw); // rest length, compliance and bending of the link
        if (link.x != 0.0 && !(may_tear && has_bit(torn, k))) {
            vec3 towards = predicted_at(words.x).xyz - own;
            add_link(towards, abs(link.x), link.x < 0.0, link.y, most_n_m);
            float bending = torn_bending(link.z, torn, words.x);
            force += sheet.bending_n_m * bending * towards;
            bending_own += bending;
        }
    }
    hessian += mat3(sheet.bending_n_m * max(bending_own, 0.0)); // torn links can make the sum negative
}

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheet_at(sheet_index);
    uint listed = sheet_of_group[2u * group + 1u] + gl_LocalInvocationID.x;
    uint local = texelFetch(particle_texels, int(listed)).x;
    if (local == cloth_no_vertex || !is_awake(sheet_index, moment.step)) {
        return;
    }
    uint particle = sheet.first + local;
    vec4 from = places[particle];
    if (from.w == 0.0) {
        return;
    }
    vec4 own = predicted[particle];
    vec3 free = foreseen(local, from.xyz, speeds[particle].xyz, pushes[particle].xyz, from.w, 0.0);
    float inertia_n_m = 1.0 / (from.w * small_step_s() * small_step_s());
    force = inertia_n_m * (free - own.xyz);
    hessian = mat3(inertia_n_m);
    // Upper limit of a stiffness. In a float sum with a larger stiffness, the particle's inertia would be
    // lost.
    float most_n_m = 1e4 * inertia_n_m;
    if ((variant & cloth_bit_grid) != 0u) {
        add_links_of_grid(local, own.xyz, most_n_m);
    } else {
        add_links_of_lists(local, own.xyz, most_n_m);
    }
    own.xyz = tethered(local, own.xyz + inverse(hessian) * force);
    predicted[particle] = own;
}
