// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_DATA
#define ESTAMPE_CLOTH_DATA

// Buffers and uniforms that all cloth passes read. The shader that includes cloth_data.glsl binds its own
// data from binding 12 on.

#include "techniques/cloth/cloth.glsl.h"

layout(constant_id = 0) const uint variant = 0u;

// Few sheets fit in a uniform buffer, so threads need no registers for a sheet's record.
#ifdef CLOTH_FEW_SHEETS
layout(scalar, binding = 0) uniform Sheets
{
    ClothSheet sheets[cloth_few_sheets];
};
#else
layout(scalar, binding = 0) readonly buffer Sheets
{
    ClothSheet sheets[];
};
#endif

layout(scalar, binding = 1) uniform Run
{
    ClothRun run;
};

layout(binding = 2) uniform usamplerBuffer link_texels; // ClothLink records of all sheets
// For each face at a particle: the face's two corners besides the particle, in order.
layout(binding = 3) uniform usamplerBuffer face_texels;
// Tethers: for each, the held particle, and the largest distance from that held particle.
layout(binding = 4) uniform usamplerBuffer tether_texels;
layout(binding = 5) uniform usamplerBuffer collider_texels;
// Targets of held particles at the beginning of the run of steps.
layout(binding = 6) uniform samplerBuffer target_before_texels;
// Targets of held particles at the end of the run of steps; w: strength of the hold.
layout(binding = 7) uniform samplerBuffer target_after_texels;

// Solids' grids of heights or distances; each grid starts with its head (nodes per axis, half the size).
layout(binding = 9) uniform samplerBuffer grid_texels;
// Front and back surfaces of bodies at the beginning of the run of steps.
layout(binding = 10) uniform usamplerBuffer seen_before_texels;
layout(binding = 11) uniform usamplerBuffer
    seen_after_texels; // front and back surfaces of bodies at the end of the run of steps; each body starts
                       // with its nodes per axis

layout(scalar, binding = 8) readonly buffer SheetOfGroup
{
    uint sheet_of_group[];
};

ClothSheet sheet; // record of the sheet that the thread processes

// Reads a sheet's record. If only one sheet exists, the record is uniform across threads, which saves
// registers.
ClothSheet sheet_at(uint sheet_index)
{
    if ((variant & cloth_bit_lone) != 0u) {
        return run.lone_sheet;
    }
    return sheets[sheet_index];
}

// The particle that a thread processes, or cloth_no_vertex beyond the sheet. The group of 64 threads starts
// at particle `first`. On grids, groups are squares, so that the particles of a group are near each other.
uint own_particle(uint first)
{
    uint thread = gl_LocalInvocationID.x;
    if ((variant & cloth_bit_grid) == 0u) {
        return first + thread < sheet.count ? first + thread : cloth_no_vertex;
    }
    uvec2 size = uvec2(sheet.columns, sheet.rows);
    uvec2 at =
        uvec2(first % size.x, first / size.x) + uvec2(thread % cloth_tile_side, thread / cloth_tile_side);
    return all(lessThan(at, size)) ? at.y * size.x + at.x : cloth_no_vertex;
}

// Time of a small step as a share of the run of simulation steps, from 0 to 1.
float part_of_run(uint step, float steps)
{
    return (float(step) + steps / float(run.small_steps)) / float(run.step_count);
}

// Target of a held particle; w is the strength of the hold.
vec4 target_of(uint local, float part)
{
    vec4 before = texelFetch(target_before_texels, int(sheet.first + local));
    vec4 after = texelFetch(target_after_texels, int(sheet.first + local));
    return before + part * (after - before); // the result is exact if the target does not move
}

float small_step_s()
{
    return run.step_s / float(run.small_steps);
}

// Predicted position of a particle after a small step; for a held particle, its target.
vec3 foreseen(uint local, vec3 place, vec3 speed, vec3 push, float inverse_mass, float part)
{
    if (inverse_mass == 0.0) {
        return target_of(local, part).xyz;
    }
    float time_s = small_step_s();
    return place + time_s * (speed + time_s * push);
}

#endif
