// SPDX-License-Identifier: MIT
// One workgroup per sheet, for CPU implementations of Vulkan: each thread has several particles, and reads
// the neighbours on a grid through a moving window.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#include "techniques/cloth/cloth.glsl.h"

layout(local_size_x = cloth_small_group) in;

const uint most_slots = cloth_small_share;
uint slots = 0u;

#include "techniques/cloth/solver/cloth_small.glsl"

// On a grid, a thread processes several consecutive particles of a column. For each row, a window holds the
// predicted positions of five neighbouring particles and moves along the row. So each position is read once
// for two or three particles.
const bool goes_by_rows = (variant & cloth_bit_grid) != 0u;
vec4 window[25];

vec4 own_predicted(uint local)
{
    return goes_by_rows ? window[12] : predicted_at(local);
}

vec4 predicted_beside(uint local, ivec2 way, bool is_there)
{
    if (goes_by_rows) {
        return window[12 + 5 * way.y + way.x];
    }
    return predicted_at(is_there ? uint(int(local) + way.y * int(sheet.columns) + way.x) : local);
}

uint strips_of(uint share)
{
    return sheet.columns * ((sheet.rows + share - 1u) / share);
}

uint slots_of_thread()
{
    uint share = (sheet.count + cloth_small_group - 1u) / cloth_small_group;
    if (goes_by_rows) {
        while (strips_of(share) > cloth_small_group) {
            ++share;
        }
    }
    return share;
}

ivec2 at_of_slot()
{
    uint thread = gl_LocalInvocationID.x;
    return ivec2(thread % sheet.columns, thread / sheet.columns * slots + slot);
}

uint local_of_slot()
{
    if (!goes_by_rows) {
        return gl_LocalInvocationID.x + slot * cloth_small_group;
    }
    ivec2 at = at_of_slot();
    return at.y < int(sheet.rows) ? uint(at.y) * sheet.columns + uint(at.x) : cloth_no_vertex;
}

void read_row(ivec2 at, int row)
{
    int y = clamp(at.y + row - 2, 0, int(sheet.rows) - 1) * int(sheet.columns);
    [[unroll]] for (int x = 0; x < 5; ++x)
    {
        window[5 * row + x] = predicted_at(uint(y + clamp(at.x + x - 2, 0, int(sheet.columns) - 1)));
    }
}

void go_on_to_next_row()
{
    [[unroll]] for (int i = 0; i < 20; ++i)
    {
        window[i] = window[i + 5];
    }
}

void small_step(uint step, uint number)
{
    slot = 0u;
    if (goes_by_rows) {
        [[unroll]] for (int row = 0; row < 4; ++row)
        {
            read_row(at_of_slot(), row);
        }
    }
    do {
        if (goes_by_rows) {
            read_row(at_of_slot(), 4);
        }
        if (local_of_slot() < sheet.count) {
            move(local_of_slot(), step, number);
        }
        if (goes_by_rows) {
            go_on_to_next_row();
        }
        ++slot;
    } while (slot < slots);
    take_turns();
}

void main()
{
    sheet = sheet_of_workgroup();
    slots = slots_of_thread();
    go_all_steps();
}
