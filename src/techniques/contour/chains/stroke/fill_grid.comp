// SPDX-License-Identifier: MIT
// One thread enters one sample into the sample grid (which finds samples by position), if the sample belongs
// to a stroke. The thread of a stroke's first sample also notes whether the stroke is longer than a scrap.
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
#define STROKES_BEFORE_BINDING 3
#include "techniques/contour/chains/lists.glsl"

#define GRID_BINDING 2
#define GRID_ACCESS
#include "techniques/contour/chains/stroke/sample_grid.glsl"

layout(scalar, binding = 4) readonly buffer Strokes
{
    Stroke strokes[];
};

layout(binding = 5) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 6
#include "techniques/contour/chains/extract/facing.glsl"
#include "techniques/contour/chains/stroke/kind_now.glsl"
#include "techniques/contour/chains/stroke/stroke_places.glsl"

layout(scalar, binding = 7) writeonly buffer ShellLines
{
    uint has_long_line[];
};

layout(push_constant, scalar) uniform Constants
{
    DropConstants constants;
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
        uint cell = cell_index(cell_of(sample_at(index).page_px, constants.size_px), constants.size_px);
        atomicMin(grid[cell].x, index);
        atomicMax(grid[cell].y, index + 1u);
        Stroke stroke = strokes[strokes_before(index + 1u) - 1u];
        if (index == stroke.first && whole_length(index, stroke) >= constants.shortest_px) {
            has_long_line[shell_of_line(sample_at(index).source)] = 1u;
        }
    }
}
