// SPDX-License-Identifier: MIT
// One thread per tile of 8 x 8 pixels lists the tile if it has sprites.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/particles/particles.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform usamplerBuffer start_texels;

#define TILE_LIST_BINDING 2
#include "shaders/tile_list_fill.glsl"

layout(push_constant, scalar) uniform Constants
{
    ParticleTiles constants;
};

bool has_sprites(uvec2 at_px)
{
    uvec2 tile = min(at_px + frame.tile_from_px, frame.page_px - 1u) / particle_tile_px;
    int index = int(tile.y * constants.tiles_across + tile.x);
    return texelFetch(start_texels, index).x < texelFetch(start_texels, index + 1).x;
}

void main()
{
    uvec2 tile = gl_GlobalInvocationID.xy;
    uvec2 from_px = 8u * tile;
    // The thread's tile of 8 x 8 pixels is smaller than the tiles with sprite lists. So each larger tile that
    // overlaps the small tile contains a corner of the small tile.
    bool is_inhabited = has_sprites(from_px) || has_sprites(from_px + uvec2(7u, 0u)) ||
                        has_sprites(from_px + uvec2(0u, 7u)) || has_sprites(from_px + 7u);
    if (all(lessThan(from_px, frame.size_px)) && is_inhabited) {
        list_tile(tile);
    }
}
