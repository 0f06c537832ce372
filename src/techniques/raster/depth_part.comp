// SPDX-License-Identifier: MIT
// One thread per texel: copies a texel of a depth picture into the rows of a larger map.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/raster.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform samplerBuffer depths;

layout(scalar, binding = 1) buffer Map
{
    uint map[];
};

layout(push_constant, scalar) uniform Constants
{
    DepthPartConstants constants;
};

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, constants.size_px))) {
        return;
    }
    uvec2 from = constants.from_px + at;
    float depth = texelFetch(depths, int(from.y * constants.picture_width_px + from.x)).x;
    map[constants.first_texel + at.y * constants.row_texels + at.x] = floatBitsToUint(depth);
}
