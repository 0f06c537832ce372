// SPDX-License-Identifier: MIT
// One thread per particle of a sheet with self-collision: inserts the particle into a hash table of cells, or
// finds the nearest particles that are not near at rest. The order inside a cell depends on the timing of
// threads, but the result does not.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "shaders/hash.glsl"
#include "techniques/cloth/cloth_data.glsl"

// Position of each particle, and its inverse mass in w.
layout(binding = 12) uniform samplerBuffer place_texels;
layout(binding = 13) uniform samplerBuffer rest_texels;

layout(scalar, binding = 14) buffer Cells
{
    uint first_in_cell[]; // hash table: the first particle in each cell, plus 1; 0: none
};

layout(scalar, binding = 15) buffer Links
{
    uint next_in_cell[];
};

layout(scalar, binding = 16) writeonly buffer Near
{
    uvec4 near[]; // four nearest particles, as indices within the sheet
};

layout(scalar, binding = 17) readonly buffer Awake
{
    uint awake_in[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothNearConstants constants;
};

#include "techniques/cloth/solver/cloth_awake.glsl"

uint cell_of(ivec3 place)
{
    return hash(uint(place.x) + 977u * sheet.first, uint(place.y), uint(place.z)) & constants.cell_mask;
}

// Merges the particles of a hash cell into the list of the nearest four. For equal distances, the lower
// particle number comes first.
void look_into(uint cell, uint particle, vec3 place, vec3 rest, inout vec4 away_m2, inout uvec4 found)
{
    float reach_m2 = 4.0 * sheet.self_m * sheet.self_m;
    for (uint item = first_in_cell[cell]; item != 0u; item = next_in_cell[max(item, 1u) - 1u]) {
        uint other = max(item, 1u) - 1u;
        bool is_own = item != 0u && other - sheet.first < sheet.count && other != particle;
        vec3 to_other = texelFetch(place_texels, int(other)).xyz - place;
        vec3 at_rest = texelFetch(rest_texels, int(other)).xyz - rest;
        float own_away_m2 = dot(to_other, to_other);
        if (!is_own || own_away_m2 > reach_m2 || dot(at_rest, at_rest) <= reach_m2) {
            continue;
        }
        uint local = other - sheet.first;
        for (int i = 0; i < 4; ++i) {
            bool is_nearer = own_away_m2 < away_m2[i] || (own_away_m2 == away_m2[i] && local < found[i]);
            bool is_listed = local == found[i];
            float moved_m2 = away_m2[i];
            uint moved = found[i];
            away_m2[i] = is_nearer ? own_away_m2 : away_m2[i];
            found[i] = is_nearer ? local : found[i];
            own_away_m2 = is_nearer ? moved_m2 : own_away_m2;
            local = is_nearer ? moved : local;
            // Skips particles that are listed: cells with an equal hash are visited repeatedly.
            if (is_listed) {
                break;
            }
        }
    }
}

void main()
{
    uint group = constants.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheet_at(sheet_index);
    uint local = own_particle(sheet_of_group[2u * group + 1u]);
    if (local == cloth_no_vertex || !is_awake(sheet_index, constants.step)) {
        return;
    }
    uint particle = sheet.first + local;
    vec3 place = texelFetch(place_texels, int(particle)).xyz;
    ivec3 cell = ivec3(floor(place / (2.0 * sheet.self_m)));
    if (constants.is_search == 0u) {
        next_in_cell[particle] = atomicExchange(first_in_cell[cell_of(cell)], particle + 1u);
        return;
    }
    vec3 rest = texelFetch(rest_texels, int(particle)).xyz;
    vec4 away_m2 = vec4(1e30);
    uvec4 found = uvec4(cloth_no_vertex);
    for (int i = 0; i < 27; ++i) {
        ivec3 there = cell + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
        look_into(cell_of(there), particle, place, rest, away_m2, found);
    }
    near[particle] = found;
}
