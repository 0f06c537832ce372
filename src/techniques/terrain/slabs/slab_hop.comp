// SPDX-License-Identifier: MIT
// One thread handles one cell of the sand. The wind may lift a slab (unit of sand) from the cell; the slab
// hops until it stays on another cell. Slabs (units of sand) read the heights before the step, and heights
// are whole numbers of slabs. So the order of threads does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/hash.glsl"
#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usamplerBuffer last_slabs;
layout(binding = 1) uniform usamplerBuffer ground;

layout(scalar, binding = 2) buffer Next
{
    uint next_slabs[];
};

layout(push_constant, scalar) uniform Constants
{
    SlabConstants slab;
};

#include "techniques/terrain/slabs/slab_lines.glsl"

// Factor on the length of hops that start at the given height of sand; 256 means a factor of 1. Hops are
// longer over crests, because the wind is faster there.
int reach_of_hop(int slabs)
{
    int above = clamp(slabs - slab.mean, -0x4000, 0x4000);
    return clamp(256 + ((slab.gain * above) >> 8), 64, 1024);
}

// Converts the length of a hop to whole cells. Fractions of a cell are rounded up or down at random, so that
// their mean is correct.
ivec2 cells_of_hop(int reach, uint bits)
{
    return ivec2(slab.hop_x * reach + int(bits & 0xffffu), slab.hop_y * reach + int(bits >> 16u)) >> 16;
}

bool stays(uint ground, uint bits)
{
    uint of = ground == slab_open_sand ? slab.on_sand : slab.on_rock;
    return ground == slab_in_lee || (bits >> 16u) < of;
}

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, ivec2(slab.side)))) {
        return;
    }
    uint cell = slab_cell(place);
    uint bits = hash(cell, slab.step, slab.seed);
    if ((bits >> 16u) >= slab.lift || texelFetch(ground, int(cell)).x != slab_open_sand) {
        return;
    }
    int reach = reach_of_hop(int(texelFetch(last_slabs, int(cell)).x));
    uint lands = cell;
    for (uint hop = 0u; hop < slab_most_hops; ++hop) {
        bits = hash(bits + hop);
        place += cells_of_hop(reach, bits);
        lands = slab_cell(place);
        bits = hash(bits);
        if (stays(texelFetch(ground, int(lands)).x, bits)) {
            break;
        }
    }
    if (lands != cell) {
        // Removes one slab (unit of sand): adding 0xffffffff subtracts 1.
        atomicAdd(next_slabs[cell], 0xffffffffu);
        atomicAdd(next_slabs[lands], 1u);
    }
}
