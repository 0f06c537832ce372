// SPDX-License-Identifier: MIT
// One thread clears four times four texels of one view.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/raster.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Views
{
    RasterView views[];
};

layout(std430, binding = 1) writeonly buffer Target
{
    uvec4 target[];
};

void main()
{
    RasterView view = views[gl_WorkGroupID.y];
    for (uint i = 0u; i < 4u; ++i) {
        uint quad = 256u * gl_WorkGroupID.x + 64u * i + gl_LocalInvocationID.x;
        if (4u * quad < view.size_px * view.size_px) {
            target[view.first_texel / 4u + quad] = uvec4(0u);
        }
    }
}
