// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_VENT
#define ESTAMPE_FLUID_VENT

// Weight with which a cell takes part in letting out the volume by which hot fluid grows. Requires two texel
// buffers, `solids` and others that fluid_fields.glsl requires. Include after fluid_fields.glsl.

float vent_weight(ivec3 cell, float rim_cells)
{
    bool is_solid =
        (variant & fluid_bit_solids) != 0u && texelFetch(solids, int(fluid_cell_index(cell))).x != 0u;
    float open = rim_cells > 0.0 ? closeness_to_rim(vec3(cell) + 0.5, rim_cells) : 1.0;
    return is_solid ? 0.0 : open;
}

#endif
