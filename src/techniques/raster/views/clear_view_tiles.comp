// SPDX-License-Identifier: MIT
// One workgroup per tile: clears one tile of a view.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#define SQUARE_TILES_BINDING 1
#include "shaders/square_tiles.glsl"
#include "techniques/raster/raster.glsl.h"

layout(local_size_x = 256) in;

layout(scalar, binding = 0) readonly buffer Views
{
    RasterView views[];
};

layout(std430, binding = 2) writeonly buffer Target
{
    uvec4 target[];
};

void main()
{
    uint first_texel = views[square_of_group()].first_texel;
    uint size_px = views[square_of_group()].size_px;
    for (uint i = 0u; i < square_tile_rounds; ++i) {
        uvec2 at = texel_of_round(i);
        target[(first_texel + at.y * size_px + at.x) / 4u] = uvec4(0u);
    }
}
