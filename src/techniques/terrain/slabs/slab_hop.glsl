// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLAB_HOP
#define ESTAMPE_SLAB_HOP

// How slabs hop. Needs `slab`, a SlabConstants.

// Hops from a cell so high are longer or shorter than the field's by so much, 256 for 1: over crests the wind
// is faster.
int reach_of_hop(int slabs)
{
    int above = clamp(slabs - slab.mean, -0x4000, 0x4000);
    return clamp(256 + ((slab.gain * above) >> 8), 64, 1024);
}

// Fractions of a cell go either way, at random, so that they add up.
ivec2 cells_of_hop(int reach, uint bits)
{
    return ivec2(slab.hop_x * reach + int(bits & 0xffffu), slab.hop_y * reach + int(bits >> 16u)) >> 16;
}

bool stays(uint ground, uint bits)
{
    uint of = ground == slab_open_sand ? slab.on_sand : slab.on_rock;
    return ground == slab_in_lee || (bits >> 16u) < of;
}

#endif
