// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SCAN_STRETCH
#define ESTAMPE_SCAN_STRETCH

// The part of a list that one workgroup processes: the index of the part's first value, and the index after
// the part's last value.
uvec2 stretch_of(uint part, uint count)
{
    uint share = (count + scan_parts - 1u) / scan_parts;
    return min(uvec2(part, part + 1u) * share, uvec2(count));
}

uint value_at(uint i)
{
    return constants.counts_bits != 0u ? uint(bitCount(values[i])) : values[i];
}

#endif
