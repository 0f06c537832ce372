// SPDX-License-Identifier: MIT
// One thread handles one piece of a line of cells along the wind, and marks its cells in the lee. The roof
// (an imaginary surface that descends downwind from each crest) over the lee depends on all upwind pieces of
// the line. The thread also copies the heights to the buffer in which slabs move.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usamplerBuffer last_slabs;

layout(scalar, binding = 1) readonly buffer Roofs
{
    int roof_after[];
};

layout(scalar, binding = 2) writeonly buffer Next
{
    uint next_slabs[];
};

layout(scalar, binding = 3) writeonly buffer Ground
{
    uint ground[];
};

layout(push_constant, scalar) uniform Constants
{
    SlabConstants slab;
};

#include "techniques/terrain/slabs/slab_lines.glsl"

int roof_upwind(int line, int piece)
{
    int steps = steps_of_piece();
    int pieces = int(slab_pieces);
    int roof = no_roof;
    for (int i = piece; i < pieces; ++i) {
        roof = max(roof - slab.drop * steps, roof_after[number_of_piece(line_upwind(line), i)]);
    }
    for (int i = 0; i < piece; ++i) {
        roof = max(roof - slab.drop * steps, roof_after[number_of_piece(line, i)]);
    }
    return roof;
}

void main()
{
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(slab_pieces, slab.side)))) {
        return;
    }
    int roof = roof_upwind(id.y, id.x);
    int steps = steps_of_piece();
    for (int i = 0; i < steps; ++i) {
        uint cell = cell_of_line(id.y, id.x * steps + i);
        uint slabs = texelFetch(last_slabs, int(cell)).x;
        int height = height_of(slabs);
        next_slabs[cell] = slabs;
        ground[cell] = height < roof ? slab_in_lee : slabs > 0u ? slab_open_sand : slab_open_rock;
        roof = max(roof, height) - slab.drop;
    }
}
