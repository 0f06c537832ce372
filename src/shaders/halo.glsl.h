// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADERS_HALO_GLSL_H
#define ESTAMPE_SHADERS_HALO_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Side in pixels of the area that one texel of the image of techniques/halo covers. The areas lie on a
// lattice of the page, so that a tile of a page has the same texels: the first texel may begin before the
// tile.
SHARED_CONSTANT uint halo_texel_px = 4U;

#ifdef __cplusplus
} // namespace estampe::shared
#else

// Pixels by which the first texel begins before a tile that begins at `tile_from_px` of the page.
uvec2 halo_offset_px(uvec2 tile_from_px)
{
    return tile_from_px % halo_texel_px;
}

// Share of the strokes that remain at a position in a tile. `halo_image`, sampled linearly, holds distances
// to things.
float left_in_halo(sampler2D halo_image, vec2 position_px, uvec2 tile_from_px, float halo_px)
{
    vec2 size_px = float(halo_texel_px) * vec2(textureSize(halo_image, 0));
    vec2 place_px = position_px + vec2(halo_offset_px(tile_from_px));
    return smoothstep(0.0, halo_px, texture(halo_image, place_px / size_px).x);
}
#endif

#endif
