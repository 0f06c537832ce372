// SPDX-License-Identifier: MIT
// Two threads test whether the ends of one stroke meet further lines. An end that meets a line is drawn up to
// the line; only free ends taper.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 128) in; // 64 strokes with 2 threads each

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define GRID_BINDING 2
#define GRID_ACCESS readonly
#include "techniques/contour/chains/stroke/sample_grid.glsl"

#define SAMPLES_BINDING 1
#define STROKES_BEFORE_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) buffer Strokes
{
    Stroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

const float meeting_px = 5.0;
// A distant part of a stroke counts as a separate line from the stroke's end on if it is more than far_along
// samples away.
const uint far_along = 8u;

bool is_dropped(uint other)
{
    return (strokes[strokes_before(other + 1u) - 1u].ends & stroke_is_dropped) != 0u;
}

bool meets_line(Stroke stroke, uint end)
{
    vec2 here = sample_at(end).page_px;
    bool meets = false;
    Cells around = cells_around(here, size_px);
    for (ivec2 cell = around.low; cell.y <= around.high.y; cell = next_cell(cell, around)) {
        uvec2 found = grid[cell_index(cell, size_px)];
        for (int k = 0; k < 2; ++k) {
            uint other = k == 0 ? found.x : found.y - 1u;
            bool is_there = found.y != 0u;
            other = is_there ? other : end;
            bool is_own = other >= stroke.first && other <= stroke.last;
            uint apart = other > end ? other - end : end - other;
            meets = meets || (is_there && !is_dropped(other) && (!is_own || apart > far_along) &&
                              size_of(sample_at(other).page_px - here) < meeting_px);
        }
    }
    return meets;
}

void main()
{
    uint index = gl_GlobalInvocationID.x / 2u;
    bool is_start = (gl_GlobalInvocationID.x & 1u) == 0u;
    if (index >= sizes[list_strokes].count) {
        return;
    }
    Stroke stroke = strokes[index];
    if (meets_line(stroke, is_start ? stroke.first : stroke.last)) {
        atomicOr(strokes[index].ends, is_start ? stroke_starts_at_line : stroke_ends_at_line);
    }
}
