// SPDX-License-Identifier: MIT
// One thread converts one LinePoint (a sample's position and width) to the pixels of a separately drawn part
// of the page. Each sample has two LinePoints.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 128) in; // 64 samples with 2 threads each

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer LinePoints
{
    LinePoint line_points[];
};

layout(scalar, binding = 2) readonly buffer LineTouches
{
    LineTouch touches[];
};

layout(scalar, binding = 3) writeonly buffer TakenPoints
{
    LinePoint taken_points[];
};

layout(scalar, binding = 4) writeonly buffer TakenTouches
{
    LineTouch taken_touches[];
};

layout(push_constant, scalar) uniform Constants
{
    PartConstants constants;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i / 2u >= sizes[list_samples].count) {
        return;
    }
    LinePoint point = line_points[i];
    taken_points[i] = LinePoint(constants.scale * point.page_px - constants.from_px,
                                constants.scale * point.half_width_px, point.ink);
    if (constants.has_touches != 0u) {
        LineTouch touch = touches[i];
        taken_touches[i] = LineTouch(constants.scale * touch.phase_px, constants.scale * touch.along_px,
                                     constants.scale * touch.whole_px, touch.way, touch.uses);
    }
}
