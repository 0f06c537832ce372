// SPDX-License-Identifier: MIT
// One thread per cell of a level: the maximum of up to four cells of the level below.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/heightfield/height_shadow.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, r32f) uniform image2D greatest_image;

layout(push_constant, scalar) uniform Constants
{
    PyramidConstants pyramid;
};

#include "techniques/shadow/heightfield/height_pyramid.glsl"

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells_of_level(pyramid.level)))) {
        return;
    }
    uint below = pyramid.level - 1u;
    ivec2 last = cells_of_level(below) - 1;
    float greatest = imageLoad(greatest_image, place_of_cell(2 * cell, below)).x;
    for (int i = 1; i < 4; ++i) {
        ivec2 child = min(2 * cell + ivec2(i & 1, i >> 1), last);
        greatest = max(greatest, imageLoad(greatest_image, place_of_cell(child, below)).x);
    }
    imageStore(greatest_image, place_of_cell(cell, pyramid.level), vec4(greatest));
}
