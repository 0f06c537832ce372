// SPDX-License-Identifier: MIT
// One thread handles one piece of a line of cells along the wind. The thread computes the height of the lee's
// roof (an imaginary surface that descends from each crest) at the end of the piece.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usamplerBuffer last_slabs;

layout(scalar, binding = 1) writeonly buffer Roofs
{
    int roof_after[];
};

layout(push_constant, scalar) uniform Constants
{
    SlabConstants slab;
};

#include "techniques/terrain/slabs/slab_lines.glsl"

void main()
{
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(slab_pieces, slab.side)))) {
        return;
    }
    int steps = steps_of_piece();
    int roof = no_roof;
    for (int i = 0; i < steps; ++i) {
        uint slabs = texelFetch(last_slabs, int(cell_of_line(id.y, id.x * steps + i))).x;
        roof = max(roof, height_of(slabs)) - slab.drop;
    }
    roof_after[number_of_piece(id.y, id.x)] = roof;
}
