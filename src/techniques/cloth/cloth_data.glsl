// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_DATA
#define ESTAMPE_CLOTH_DATA

// Data that all passes over cloth read. The including shader binds its own data from binding 12 on.

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

layout(binding = 2) uniform usamplerBuffer link_texels;   // ClothLink
layout(binding = 3) uniform usamplerBuffer face_texels;   // the two other corners, in order
layout(binding = 4) uniform usamplerBuffer tether_texels; // held particle, and largest distance from it
layout(binding = 5) uniform usamplerBuffer collider_texels;
layout(binding = 6) uniform samplerBuffer target_before_texels; // targets of held particles at the beginning
layout(binding = 7) uniform samplerBuffer target_after_texels;  // and the end of a run; w: how strongly held

layout(binding = 9) uniform samplerBuffer grid_texels; // heights or distances, each grid after its head
layout(binding = 10) uniform usamplerBuffer seen_before_texels; // front and back of bodies at the beginning
layout(binding = 11) uniform usamplerBuffer
    seen_after_texels; // and the end of a run; each body after its head

layout(scalar, binding = 8) readonly buffer SheetOfGroup
{
    uint sheet_of_group[];
};

ClothSheet sheet; // the sheet of this thread

// With a single sheet these values are uniform across threads, which saves registers.
ClothSheet sheet_at(uint sheet_index)
{
    if ((variant & cloth_bit_lone) != 0u) {
        return run.lone_sheet;
    }
    return sheets[sheet_index];
}

// The particle of a thread; the group of 64 threads starts at particle `first`. On grids, groups are squares,
// so that the particles of a group are near each other. cloth_no_vertex beyond the sheet.
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

// Position of a small step in the run, from 0 to 1.
float part_of_run(uint step, float steps)
{
    return (float(step) + steps / float(run.small_steps)) / float(run.step_count);
}

// Target of a held particle; in w, how strongly the particle is held.
vec4 target_of(uint local, float part)
{
    vec4 before = texelFetch(target_before_texels, int(sheet.first + local));
    vec4 after = texelFetch(target_after_texels, int(sheet.first + local));
    return before + part * (after - before); // a still target stays exact
}

float small_step_s()
{
    return run.step_s / float(run.small_steps);
}

// Predicted position of a free particle after a small step, or the target of a held one.
vec3 foreseen(uint local, vec3 place, vec3 speed, vec3 push, float inverse_mass, float part)
{
    if (inverse_mass == 0.0) {
        return target_of(local, part).xyz;
    }
    float time_s = small_step_s();
    return place + time_s * (speed + time_s * push);
}

#endif
