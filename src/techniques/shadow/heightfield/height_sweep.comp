// SPDX-License-Identifier: MIT
// One thread walks one line away from the sun. For each step it finds the earlier step that appears highest
// from the current step. The earlier steps form a convex hull. Each step stores the hull's next step towards
// the sun, so that the results also serve as the stack of the hull's steps. Each step is removed from the
// hull at most once.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/heightfield/height_shadow.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler2D height_image;

layout(scalar, binding = 1) buffer Seen
{
    uint seen_step[]; // for each step of a line: number of the step that forms its horizon towards the sun
};

layout(push_constant, scalar) uniform Constants
{
    SweepConstants sweep;
};

#include "techniques/shadow/heightfield/height_lines.glsl"

struct Corner {
    uint step;
    float height_m;
};

Corner corner(uint step, int line)
{
    return step == height_no_step ? Corner(step, 0.0)
                                  : Corner(step, height_of_line(step, line + moved_across(step)));
}

float rise_to(Corner from, Corner to)
{
    return (to.height_m - from.height_m) / float(from.step - to.step);
}

uint seen_from(uint step, int line)
{
    return step == height_no_step ? height_no_step : seen_step[cell_of(step, line + moved_across(step))];
}

void main()
{
    int across = texels_across();
    int last_move = moved_across(step_total() - 1u);
    int line = int(gl_GlobalInvocationID.x) - max(last_move, 0);
    if (line > across - min(last_move, 0)) {
        return;
    }
    Corner top = Corner(height_no_step, 0.0);
    Corner below = top;
    if (sweep.first_step > 0u) {
        int before = line + moved_across(sweep.first_step - 1u);
        if (before >= 0 && before <= across) {
            top = corner(sweep.first_step - 1u, line);
            below = corner(seen_from(top.step, line), line);
        }
    }
    for (uint step = sweep.first_step; step < sweep.end_step; ++step) {
        int c = line + moved_across(step);
        if (c < 0 || c > across) {
            continue;
        }
        Corner here = Corner(step, height_of_line(step, c));
        while (below.step != height_no_step && rise_to(here, below) >= rise_to(here, top)) {
            top = below;
            below = corner(seen_from(top.step, line), line);
        }
        seen_step[cell_of(step, c)] = top.step;
        below = top;
        top = here;
    }
}
