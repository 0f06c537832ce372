// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_AWAKE
#define ESTAMPE_CLOTH_AWAKE

// Tells whether a sheet moves in a step. Wind keeps all sheets awake; the test is skipped if wind blows.
//
// Requires: uint awake_in[], which is 1 more than the last step in which each sheet was awake.

#include "techniques/cloth/cloth_data.glsl"

bool is_awake(uint sheet_index, uint step)
{
    return (variant & cloth_bit_roused) != 0u || awake_in[sheet_index] == step + 1u;
}

#endif
