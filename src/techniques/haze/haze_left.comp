// SPDX-License-Identifier: MIT
// One thread per pixel writes the share of ink that haze leaves, for strokes and for lines.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/haze/haze.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(push_constant, scalar) uniform Constants
{
    HazeConstants constants;
};

#define HAZE_DEPTH_BINDING 1
#include "techniques/haze/haze.glsl"

layout(scalar, binding = 2) writeonly buffer Left
{
    vec2 left[]; // share of ink that haze leaves, of strokes and of lines, row by row
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float depth = haze_depth(pixel);
    float of_line = line_depth(pixel, depth);
    left[uint(pixel.y) * frame.size_px.x + uint(pixel.x)] =
        vec2(depth > 0.0 ? ink_left(pixel, depth) : 1.0, of_line >= 0.0 ? ink_left(pixel, of_line) : 1.0);
}
