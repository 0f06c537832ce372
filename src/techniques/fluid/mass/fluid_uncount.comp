// SPDX-License-Identifier: MIT
// One thread per cell: converts whole units back to quantities, the reverse of fluid_count.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform usamplerBuffer units;
layout(binding = 1, r32f) writeonly uniform image2DArray out_quantities;

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
        int count = int(texelFetch(units, int(mass_index(fluid_cell_index(cell), channel))).x);
        imageStore(out_quantities, ivec3(cell.xy, channel * grid.depth + cell.z),
                   vec4(float(count) / float(fluid_mass_unit)));
    }
}
