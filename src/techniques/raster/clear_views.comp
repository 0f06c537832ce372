// SPDX-License-Identifier: MIT
// One thread clears four texels of one view.
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
    if (4u * gl_GlobalInvocationID.x < view.size_px * view.size_px) {
        target[view.first_texel / 4u + gl_GlobalInvocationID.x] = uvec4(0u);
    }
}
