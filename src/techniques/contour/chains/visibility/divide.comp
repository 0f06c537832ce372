// SPDX-License-Identifier: MIT
// One thread computes the number of even steps into which one chain is divided. In a closed chain, the last
// sample is at the position of the first sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 2) readonly buffer FlagsOfSlot
{
    uint flags_of_slot[];
};

#define POINTS_BEFORE_BINDING 1
#define LENGTHS_BEFORE_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) writeonly buffer SamplesOfSlot
{
    uint samples_of_slot[];
};

layout(scalar, binding = 5) writeonly buffer RotationOfSlot
{
    uint rotation_of_slot[];
};

layout(push_constant, scalar) uniform Constants
{
    ChainConstants constants;
};

const float shortest_px = 1.5;

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= sizes[list_slots].count) {
        return;
    }
    uint first = points_before(slot);
    uint end = points_before(slot + 1u);
    uint count = 0u;
    if (end > first && end <= sizes[list_points].count) {
        float length_px = float(lengths_before(end - 1u) - lengths_before(first)) / length_unit_px;
        bool is_closed = (flags_of_slot[slot] & chain_is_closed) != 0u;
        uint steps = max(uint(ceil(length_px / constants.step_px)), is_closed ? 3u : 1u);
        count = length_px >= shortest_px ? steps + 1u : 0u;
    }
    samples_of_slot[slot] = count;
    rotation_of_slot[slot] = no_rotation;
}
