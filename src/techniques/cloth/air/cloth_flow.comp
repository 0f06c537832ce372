// SPDX-License-Identifier: MIT
// One thread per cell of a periodic fluid: the velocity in the middle of the cell, along the axes of the
// cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/cloth/cloth.glsl.h"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

// velocity of the fluid; each component is stored on the low faces of cells
layout(binding = 0) uniform sampler2DArray velocity;

layout(scalar, binding = 1) writeonly buffer Flow
{
    vec4 flow[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothFlow box;
};

float component_at(ivec3 cell, int axis)
{
    ivec3 size = ivec3(box.cells);
    ivec3 next = cell;
    next[axis] = (cell[axis] + 1) % size[axis];
    float low = texelFetch(velocity, ivec3(cell.xy, axis * size.z + cell.z), 0).x;
    float high = texelFetch(velocity, ivec3(next.xy, axis * size.z + next.z), 0).x;
    return 0.5 * (low + high);
}

void main()
{
    uvec3 cell = gl_GlobalInvocationID;
    if (any(greaterThanEqual(cell, box.cells))) {
        return;
    }
    vec3 own = vec3(component_at(ivec3(cell), 0), component_at(ivec3(cell), 1), component_at(ivec3(cell), 2));
    mat3 cells_from_place = mat3(box.cells_from_place); // the matrix also divides by the size of a cell
    vec3 speed = own * cells_from_place / length(cells_from_place[0]);
    flow[box.first + (cell.z * box.cells.y + cell.y) * box.cells.x + cell.x] = vec4(speed, 0.0);
}
