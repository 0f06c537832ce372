// SPDX-License-Identifier: MIT
// One thread handles one texel and finds the least distance to a thing along a row or a column of texels. Run
// over the rows and then over the columns, the result is the exact distance between texel centres, in pixels:
// Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 2012.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/halo.glsl.h"
#include "techniques/halo/halo.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D distance_image;
layout(binding = 1, r16f) writeonly uniform image2D out_distance;

layout(push_constant, scalar) uniform Constants
{
    HaloConstants constants;
};

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, constants.size_texels))) {
        return;
    }
    float least = 60000.0;
    for (int i = -constants.reach_texels; i <= constants.reach_texels; ++i) {
        ivec2 at = clamp(texel + i * constants.along, ivec2(0), constants.size_texels - 1);
        least =
            min(least, length(vec2(texelFetch(distance_image, at, 0).x, float(halo_texel_px) * float(i))));
    }
    imageStore(out_distance, texel, vec4(least));
}
