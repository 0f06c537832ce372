// SPDX-License-Identifier: MIT
// One thread per cell of any multigrid level: openings of the cell's faces towards lower x and lower y, as
// two half floats. In the grid itself an opening is 1, or 0 at a wall or an obstacle. The opening of a
// coarser face is half the sum of the finer openings that the face covers. So the Galerkin operator of
// aggregated cells equals the operator of the coarser grid.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform usamplerBuffer solids;

layout(scalar, binding = 1) writeonly buffer Weights
{
    uint out_weights[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidWeights levels;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/pressure/fluid_extent.glsl"

bool is_open(ivec2 cell)
{
    return (variant & fluid_bit_solids) == 0u ||
           texelFetch(solids, cell.y * int(grid.width) + cell.x).x == 0u;
}

// Number of open faces of the finest grid in a coarser cell's face, from `cell` on.
float open_faces(ivec2 cell, int axis, int span)
{
    ivec2 size = fluid_size().xy;
    if (cell[axis] == 0 && !is_periodic(axis)) {
        return 0.0;
    }
    int along = 1 - axis;
    int count = min(span, size[along] - cell[along]);
    if ((variant & fluid_bit_solids) == 0u) {
        return float(count);
    }
    ivec2 other = cell;
    other[axis] = cell[axis] == 0 ? size[axis] - 1 : cell[axis] - 1;
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        sum += is_open(cell) && is_open(other) ? 1.0 : 0.0;
        ++cell[along];
        ++other[along];
    }
    return sum;
}

void main()
{
    uint item = item_index();
    if (item >= levels.cell_count) {
        return;
    }
    int left = int(item);
    ivec2 size = fluid_size().xy;
    int level = 0;
    while (left >= size.x * size.y) {
        left -= size.x * size.y;
        size = (size + 1) / 2;
        ++level;
    }
    ivec2 coarse = ivec2(left % size.x, left / size.x);
    int span = 1 << level;
    vec2 open = vec2(open_faces(coarse << level, 0, span), open_faces(coarse << level, 1, span));
    open *= vec2(nearness(coarse.x, size.x, level, int(grid.width)),
                 nearness(coarse.y, size.y, level, int(grid.height)));
    out_weights[item] = packHalf2x16(open / float(span));
}
