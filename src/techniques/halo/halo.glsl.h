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

struct HaloThingConstants {
    uvec2 ground_draws; // draw calls of the ground and the terrain; UINT_MAX where there is none
    int edge_px;        // edges between level surfaces are no things up to this width
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
