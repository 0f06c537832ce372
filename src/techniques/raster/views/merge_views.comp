// SPDX-License-Identifier: MIT
// One thread merges four texels of one view: each texel keeps the nearer of the two depths.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/raster.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Views
{
    RasterView views[];
};

layout(std430, binding = 1) readonly buffer Source
{
    uvec4 source[];
};

layout(std430, binding = 2) buffer Target
{
    uvec4 target[];
};

void main()
{
    RasterView view = views[gl_WorkGroupID.y];
    if (4u * gl_GlobalInvocationID.x < view.size_px * view.size_px) {
        uint place = view.first_texel / 4u + gl_GlobalInvocationID.x;
        target[place] = max(target[place], source[place]);
    }
}
