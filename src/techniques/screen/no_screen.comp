// SPDX-License-Identifier: MIT
// One thread writes the blank texel that stands for a screen where there is none.
#version 460

layout(local_size_x = 1) in;

layout(binding = 0, r32ui) writeonly uniform uimage2D out_draw;
layout(binding = 1, rgba8) writeonly uniform image2D out_color;

void main()
{
    imageStore(out_draw, ivec2(0), uvec4(0u));
    imageStore(out_color, ivec2(0), vec4(0.0));
}
