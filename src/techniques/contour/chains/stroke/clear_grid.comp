// SPDX-License-Identifier: MIT
// One thread clears one cell of the sample grid, which finds samples by their position on the page, and the
// note on the lines of one shell (connected surface).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

#define GRID_BINDING 0
#define GRID_ACCESS writeonly
#include "techniques/contour/chains/stroke/sample_grid.glsl"

layout(scalar, binding = 1) writeonly buffer ShellLines
{
    uint has_long_line[]; // for each shell (connected surface): 1 if a stroke of it has the least length
};

layout(push_constant, scalar) uniform Constants
{
    uvec2 counts; // number of grid cells, and of shells
};

void main()
{
    uint index = item_index();
    if (index < counts.x) {
        grid[index] = uvec2(no_sample, 0u);
    }
    if (index < counts.y) {
        has_long_line[index] = 0u;
    }
}
