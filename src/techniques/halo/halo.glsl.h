// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HALO_GLSL_H
#define ESTAMPE_HALO_GLSL_H
// Data that the shaders of halos share with C++.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Distances of texels without things, before the search: of floor and ground, and of sky and bare paper. Half
// floats hold both exactly, and both are beyond every halo.
SHARED_CONSTANT float floor_px = 60000.0F;
SHARED_CONSTANT float blank_px = 40000.0F;

struct HaloThingConstants {
    uvec2 ground_draws; // draw calls of the ground and the terrain; UINT_MAX where there is none
};

struct HaloEdgeConstants {
    ivec2 size_texels;
    int reach_texels; // distance at which a floor is searched on two opposite sides
};

struct HaloConstants {
    ivec2 size_texels;
    ivec2 along; // direction of the search, in texels
    int reach_texels;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
