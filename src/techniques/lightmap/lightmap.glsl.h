// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIGHTMAP_GLSL_H
#define ESTAMPE_LIGHTMAP_GLSL_H

#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_lightmap = 0xffffffffU;

// The lightmap of one draw (one primitive of a mesh in one place).
struct LightmapSlot {
    uint layer; // layer of the image array of lightmaps; no_lightmap if the draw has none
    float strength;
};

#ifdef __cplusplus
static_assert(sizeof(LightmapSlot) == 8);
} // namespace estampe::shared
#endif

#endif
