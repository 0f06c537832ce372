// SPDX-License-Identifier: MIT
// One thread enters one sample into the sample grid (which finds samples by position), if the sample belongs
// to a stroke.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SAMPLES_BINDING 1
#include "techniques/contour/chains/lists.glsl"

#define GRID_BINDING 2
#define GRID_ACCESS
#include "techniques/contour/chains/stroke/sample_grid.glsl"

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count) {
        return;
    }
    bool is_drawn = (sample_at(index).state & piece_is_there) != 0u ||
                    (index > 0u && (sample_at(index - 1u).state & piece_is_there) != 0u);
    if (is_drawn) {
        uint cell = cell_index(cell_of(sample_at(index).page_px, size_px), size_px);
        atomicMin(grid[cell].x, index);
        atomicMax(grid[cell].y, index + 1u);
    }
}
