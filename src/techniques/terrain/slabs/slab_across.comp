// SPDX-License-Identifier: MIT
// One thread handles one cell of the sand: it interpolates the cell's height, in slabs (units of sand),
// between two simulation steps. The thread also smooths heights along x.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usamplerBuffer last_slabs;
layout(binding = 1) uniform usamplerBuffer next_slabs;
layout(binding = 2, r32f) writeonly uniform image2D out_slabs;

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
        int cell = place.y * int(height.side) + ((place.x + i - radius) & (int(height.side) - 1));
        sum += weight * mix(float(texelFetch(last_slabs, cell).x), float(texelFetch(next_slabs, cell).x),
                            height.fraction);
        weight = weight_after(weight, i);
    }
    imageStore(out_slabs, place, vec4(sum));
}
