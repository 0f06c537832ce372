// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_DATA
#define ESTAMPE_CLOTH_DATA

// What all passes over cloth read. Those after it bind from 12 on.

#include "techniques/cloth/cloth.glsl.h"

layout(constant_id = 0) const uint variant = 0u;

#ifdef CLOTH_FEW_SHEETS // whose numbers threads need not keep
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

layout(binding = 2) uniform usamplerBuffer link_texels; // ClothLink
layout(binding = 3) uniform usamplerBuffer face_texels; // the other two corners, in order
layout(binding = 4) uniform usamplerBuffer
    tether_texels; // particle that is held, and how far from it at most
layout(binding = 5) uniform usamplerBuffer collider_texels;
layout(binding = 6) uniform samplerBuffer target_before_texels; // where held particles are at the beginning
layout(binding = 7) uniform samplerBuffer target_after_texels;  // of a run, and at its end; how much, last

layout(binding = 9) uniform samplerBuffer grid_texels; // of heights or distances, each behind its head
layout(binding = 10) uniform usamplerBuffer seen_before_texels; // of bodies at the beginning of a run, and at
layout(binding = 11) uniform usamplerBuffer
    seen_after_texels; // its end: bits of floats, each behind its head

layout(scalar, binding = 8) readonly buffer SheetOfGroup
{
    uint sheet_of_group[];
};

ClothSheet sheet; // of this thread

// Of a lone one all numbers are the same for all threads, which need not keep them.
ClothSheet sheet_at(uint sheet_index)
{
    if ((variant & cloth_bit_lone) != 0u) {
        return run.lone_sheet;
    }
    return sheets[sheet_index];
}

// The particle of a thread of 64, whose workgroup begins with `first`: of grids they take squares, so that
// those of a group are near each other. None beyond the sheet.
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

// Of a run, from 0 to 1.
float part_of_run(uint step, float steps)
{
    return (float(step) + steps / float(run.small_steps)) / float(run.step_count);
}

// Where a particle is wanted that is held, and how much it is.
vec4 target_of(uint local, float part)
{
    vec4 before = texelFetch(target_before_texels, int(sheet.first + local));
    vec4 after = texelFetch(target_after_texels, int(sheet.first + local));
    return before + part * (after - before); // what stands still does so to the bit
}

float small_step_s()
{
    return run.step_s / float(run.small_steps);
}

// Where a particle goes by itself in a small step, or is put.
vec3 foreseen(uint local, vec3 place, vec3 speed, vec3 push, float inverse_mass, float part)
{
    if (inverse_mass == 0.0) {
        return target_of(local, part).xyz;
    }
    float time_s = small_step_s();
    return place + time_s * (speed + time_s * push);
}

#endif
