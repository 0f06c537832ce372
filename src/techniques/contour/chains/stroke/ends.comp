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

#include "techniques/contour/chains/stroke/meetings.glsl"

void main()
{
    uint index = gl_GlobalInvocationID.x / 2u;
    bool is_start = (gl_GlobalInvocationID.x & 1u) == 0u;
    if (index >= sizes[list_strokes].count) {
        return;
    }
    Stroke stroke = strokes[index];
    if (meets_line(stroke, is_start ? stroke.first : stroke.last, size_px, false)) {
        atomicOr(strokes[index].ends, is_start ? stroke_starts_at_line : stroke_ends_at_line);
    }
}
