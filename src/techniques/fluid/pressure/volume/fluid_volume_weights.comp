// SPDX-License-Identifier: MIT
// One thread per cell of any level of the 3D multigrid: openings of the cell's faces towards lower x, y and
// z, as three half floats. As in fluid_weights.comp, the opening of a coarser face is half the sum of the
// finer openings that the face covers, or more next to the last, narrower cell.
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
    uvec2 out_weights[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
    FluidWeights levels;
};

#include "techniques/fluid/fluid_fields.glsl"
#include "techniques/fluid/pressure/fluid_extent.glsl"

bool is_open(ivec3 cell)
{
    return (variant & fluid_bit_solids) == 0u || texelFetch(solids, int(fluid_cell_index(cell))).x == 0u;
}

// Number of open faces of the finest grid in a coarser cell's face, from `low` on.
float open_faces(ivec3 low, int axis, int span)
{
    if (low[axis] == 0 && !is_periodic(axis)) {
        return 0.0;
    }
    ivec3 count = min(ivec3(span), fluid_size() - low);
    count[axis] = 1;
    if ((variant & fluid_bit_solids) == 0u) {
        return float(count.x * count.y * count.z);
    }
    float sum = 0.0;
    for (int i = 0; i < count.x * count.y * count.z; ++i) {
        ivec3 cell = low + ivec3(i % count.x, i / count.x % count.y, i / (count.x * count.y));
        ivec3 before = cell;
        before[axis] = cell[axis] == 0 ? fluid_size()[axis] - 1 : cell[axis] - 1;
        sum += is_open(cell) && is_open(before) ? 1.0 : 0.0;
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
    ivec3 size = fluid_size();
    int level = 0;
    while (left >= size.x * size.y * size.z) {
        left -= size.x * size.y * size.z;
        size = (size + 1) / 2;
        ++level;
    }
    ivec3 coarse = ivec3(left % size.x, left / size.x % size.y, left / (size.x * size.y));
    int span = 1 << level;
    vec3 open;
    for (int axis = 0; axis < 3; ++axis) {
        open[axis] = open_faces(coarse << level, axis, span) *
                     nearness(coarse[axis], size[axis], level, fluid_size()[axis]) / float(span);
    }
    out_weights[item] = uvec2(packHalf2x16(open.xy), packHalf2x16(vec2(open.z, 0.0)));
}
