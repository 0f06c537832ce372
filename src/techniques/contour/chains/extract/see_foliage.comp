// SPDX-License-Identifier: MIT
// One thread finds what one point of the page lattice (a grid of points on the page) shows, in the format of
// FoliagePoint.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/tone.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

#define FOLIAGE_PIXELS_BINDING 0
#include "techniques/contour/chains/extract/foliage.glsl"

layout(binding = 3) uniform sampler2D light_image;

layout(scalar, binding = 4) writeonly buffer Foliage
{
    uvec2 points[];
};

layout(push_constant, scalar) uniform Constants
{
    FoliageConstants constants;
};

void main()
{
    uvec2 point = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(point, uvec2(constants.columns, constants.rows)))) {
        return;
    }
    ivec2 pixel = ivec2(cell_px * point);
    float lightness = 1.0 - darkness(constants.tone, texelFetch(light_image, pixel, 0).a, 1.0);
    points[point.y * constants.columns + point.x] =
        uvec2(foliage_place(pixel) | uint(127.0 * lightness + 0.5) << 1, uint(pixel.y) << 16 | uint(pixel.x));
}
