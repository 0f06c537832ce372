// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_VOLUME_LEVEL
#define ESTAMPE_FLUID_VOLUME_LEVEL

// A level of the 3D multigrid. Requires `variant`; `weights`, a texel buffer; and `level`, a
// FluidVolumeLevel. The pressure equation of a cell is the equation in fluid_tile.glsl, with six faces.

ivec3 level_size()
{
    return ivec3(level.width, level.height, level.depth);
}

int index_of(ivec3 cell)
{
    return (cell.z * int(level.height) + cell.y) * int(level.width) + cell.x;
}

// The neighbour of a cell along an axis; at a wall the cell itself.
ivec3 neighbour(ivec3 cell, int axis, int step)
{
    int size = level_size()[axis];
    bool wraps = (variant & (fluid_bit_periodic << axis)) != 0u;
    int place = cell[axis] + step;
    cell[axis] = place >= 0 && place < size ? place
                 : !wraps                   ? cell[axis]
                 : place < 0                ? place + size
                                            : place - size;
    return cell;
}

// Openings of a cell's faces towards lower x, y and z.
vec3 lower_openings(ivec3 cell)
{
    uvec2 packed = texelFetch(weights, int(level.first) + index_of(cell)).xy;
    return vec3(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y).x);
}

// Opening of a cell's face at the high end of an axis; 0 at a wall.
float upper_opening(ivec3 cell, int axis)
{
    ivec3 next = neighbour(cell, axis, 1);
    bool is_wall = next == cell && (variant & (fluid_bit_periodic << axis)) == 0u;
    return is_wall ? 0.0 : lower_openings(next)[axis];
}

#endif
