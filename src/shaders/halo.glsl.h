// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADERS_HALO_GLSL_H
#define ESTAMPE_SHADERS_HALO_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Side in pixels of the area of the page that one texel of the image of techniques/halo covers.
SHARED_CONSTANT uint halo_texel_px = 4U;

#ifdef __cplusplus
} // namespace estampe::shared
#else

// Share of the strokes that remain at a pixel. `halo_image`, sampled linearly, holds distances to things.
float left_in_halo(sampler2D halo_image, vec2 position_px, float halo_px)
{
    vec2 size_px = float(halo_texel_px) * vec2(textureSize(halo_image, 0));
    return smoothstep(0.0, halo_px, texture(halo_image, position_px / size_px).x);
}
#endif

#endif
