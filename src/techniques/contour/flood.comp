// SPDX-License-Identifier: MIT
// One round of jump flooding: each pixel takes the nearest seed (short piece of line) that is known at the
// pixel, or at a pixel one step away in one of eight directions. Rong and Tan, "Jump Flooding in GPU with
// Applications to Voronoi Diagram and Distance Transform", I3D 2006.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/contour.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2D nearest_image;
layout(binding = 1, r32ui) writeonly uniform uimage2D out_nearest;

layout(push_constant, scalar) uniform Constants
{
    FloodConstants constants;
};

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(constants.width, constants.height);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    uint best = no_seed;
    int best_distance = 0x7fffffff;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = pixel + ivec2(x, y) * int(constants.step_px);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
                continue;
            }
            uint seed = texelFetch(nearest_image, at, 0).x;
            ivec2 away = ivec2(seed & 0xffffu, seed >> 16) - pixel;
            int distance = away.x * away.x + away.y * away.y;
            if (seed != no_seed && distance < best_distance) {
                best = seed;
                best_distance = distance;
            }
        }
    }
    imageStore(out_nearest, pixel, uvec4(best));
}
