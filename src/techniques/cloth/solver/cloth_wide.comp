// SPDX-License-Identifier: MIT
// One workgroup per sheet, for GPUs: a thread has one particle or few particles. The particles' values stay
// in registers, and the many threads hide memory latency.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#define CLOTH_FEW_SHEETS

#include "techniques/cloth/cloth.glsl.h"

layout(local_size_x = cloth_wide_group) in;

const uint most_slots = cloth_small_sheet / cloth_wide_group;
const uint slots = most_slots; // constant, so that loops have a known end

#include "techniques/cloth/solver/cloth_small.glsl"

vec4 own_predicted(uint local)
{
    return predicted_at(local);
}

vec4 predicted_beside(uint local, ivec2 way, bool is_there)
{
    return predicted_at(is_there ? uint(int(local) + way.y * int(sheet.columns) + way.x) : local);
}

uint local_of_slot()
{
    return gl_LocalInvocationID.x + slot * cloth_wide_group;
}

void small_step(uint step, uint number)
{
    [[unroll]] for (slot = 0u; slot < slots; ++slot)
    {
        if (local_of_slot() < sheet.count) {
            move(local_of_slot(), step, number);
        }
    }
    take_turns();
}

void main()
{
    sheet = sheet_of_workgroup();
    go_all_steps();
}
