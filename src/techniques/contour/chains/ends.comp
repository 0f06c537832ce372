// SPDX-License-Identifier: MIT
// One thread asks of one stroke whether its ends meet other lines: those are drawn right up to them, and only
// free ends run out.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer CutSamples
{
    LineSample samples[];
};

#define GRID_BINDING 2
#define GRID_ACCESS readonly
#include "techniques/contour/chains/sample_grid.glsl"

layout(scalar, binding = 3) readonly buffer StrokesBefore
{
    uint strokes_before[];
};

layout(scalar, binding = 4) buffer Strokes
{
    Stroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

const float meeting_px = 5.0;
const uint far_along = 8u; // samples; nearer ones are the stroke itself

bool is_dropped(uint other)
{
    return (strokes[strokes_before[other + 1u] - 1u].ends & STROKE_IS_DROPPED) != 0u;
}

bool meets_line(Stroke stroke, uint end)
{
    bool meets = false;
    for (int i = 0; i < 9; ++i) {
        uvec2 found = grid[cell_at(samples[end].page_px, ivec2(i % 3 - 1, i / 3 - 1), size_px)];
        for (int k = 0; k < 2; ++k) {
            uint other = k == 0 ? found.x : found.y - 1u;
            bool is_there = found.y != 0u;
            other = is_there ? other : end;
            bool is_own = other >= stroke.first && other <= stroke.last;
            uint apart = other > end ? other - end : end - other;
            meets = meets || (is_there && !is_dropped(other) && (!is_own || apart > far_along) &&
                              distance(samples[other].page_px, samples[end].page_px) < meeting_px);
        }
    }
    return meets;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[LIST_STROKES].count) {
        return;
    }
    Stroke stroke = strokes[index];
    // Others ask meanwhile whether this one is dropped: that bit stays as it is.
    strokes[index].ends = stroke.ends | (meets_line(stroke, stroke.first) ? STROKE_STARTS_AT_LINE : 0u) |
                          (meets_line(stroke, stroke.last) ? STROKE_ENDS_AT_LINE : 0u);
}
