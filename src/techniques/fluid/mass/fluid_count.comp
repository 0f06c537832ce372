// SPDX-License-Identifier: MIT
// One thread per cell: rounds the masses of quantities in the cell to whole units.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray quantities;

layout(scalar, binding = 1) writeonly buffer Units
{
    int units[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidMass moved;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/mass/fluid_shares.glsl"

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    for (uint channel = 0u; channel < moved.channels; ++channel) {
        float quantity = texelFetch(quantities, ivec3(cell.xy, channel * grid.depth + cell.z), 0).x;
        // A sum of several cells must not overflow 32 bits.
        quantity = clamp(quantity, -fluid_most_quantity, fluid_most_quantity);
        units[mass_index(fluid_cell_index(cell), channel)] = int(round(quantity * float(fluid_mass_unit)));
    }
}
