// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SWEEP_LINES
#define ESTAMPE_SWEEP_LINES

// Positions where the lines of a height-field sweep cross the field, see height_shadow.glsl.h. Integer
// arithmetic gives identical positions in all shaders. The functions apply to the height field of the calling
// thread. Requires `sweep`, a SweepConstants, and height_image.

// Number of steps of the sweep over the field.
uint step_total()
{
    return sweep.steps_along_y != 0u ? sweep.size.y : sweep.size.x;
}

// Number of the field's texels in one step of the sweep (a row or a column).
int texels_across()
{
    return int(sweep.steps_along_y != 0u ? sweep.size.x : sweep.size.y);
}

// Whole part of the distance, in texels, that the sweep's lines have moved sideways at a step.
int moved_across(uint step)
{
    return (sweep.slope * int(step)) >> 16;
}

// Fractional part of the distance that the sweep's lines have moved sideways. In each step, the line number c
// is at the texel position c - 1 + fraction.
float fraction_across(uint step)
{
    return float((sweep.slope * int(step)) & 0xffff) / 65536.0;
}

ivec2 texel_at(uint step, int across)
{
    int along = int(sweep.from_far_end != 0u ? step_total() - 1u - step : step);
    return sweep.steps_along_y != 0u ? ivec2(across, along) : ivec2(along, across);
}

ivec2 place_of_texel(ivec2 texel)
{
    return texel + ivec2(0, gl_GlobalInvocationID.z * sweep.size.y);
}

float height_of_texel(uint step, int across)
{
    ivec2 texel = texel_at(step, clamp(across, 0, texels_across() - 1));
    return texelFetch(height_image, place_of_texel(texel), 0).x;
}

// Height of the ground where line `c` of the sweep crosses a step.
float height_of_line(uint step, int c)
{
    return mix(height_of_texel(step, c - 1), height_of_texel(step, c), fraction_across(step));
}

uint cell_of(uint step, int c)
{
    uint steps_before = gl_GlobalInvocationID.z * step_total() + step;
    return steps_before * uint(texels_across() + 1) + uint(c);
}

#endif
