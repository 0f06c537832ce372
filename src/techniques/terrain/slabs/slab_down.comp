// SPDX-License-Identifier: MIT
// One thread handles one cell of the sand: it smooths heights along y and converts them from slabs to metres.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D across_image;
layout(binding = 1, r32f) writeonly uniform image2D out_height;

layout(push_constant, scalar) uniform Constants
{
    SlabHeightConstants height;
};

#include "techniques/terrain/slabs/slab_weights.glsl"

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, ivec2(height.side)))) {
        return;
    }
    int radius = int(height.radius);
    float sum = 0.0;
    float weight = weight_of_outermost();
    for (int i = 0; i <= 2 * radius; ++i) {
        int row = (place.y + i - radius) & (int(height.side) - 1);
        sum += weight * texelFetch(across_image, ivec2(place.x, row), 0).x;
        weight = weight_after(weight, i);
    }
    imageStore(out_height, place, vec4(height.slab_m * sum));
}
