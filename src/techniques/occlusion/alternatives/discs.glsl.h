// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISCS_GLSL_H
#define ESTAMPE_DISCS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint disc_children = 8U;    // of a node
SHARED_CONSTANT uint most_disc_levels = 9U; // of a tree, its discs among them

// A disc, or all discs below a node: two texels of 16 bytes.
struct Disc {
    vec3 place;
    float radius_m; // of a ball that holds the middles of all; 0 of a single disc
    vec3 facing_m2; // sum of the normals times the areas
    float area_m2;  // sum of the areas
};

// The tree's levels lie one after another, discs first; level i has `counts[i]` nodes.
struct DiscConstants {
    uint counts[most_disc_levels];
    uint level_count;
    uint level;     // in hand
    float radius_m; // occluders farther off count for nothing
    float apart;    // a node is looked at whole from where its ball seems this wide: radius over distance
    float strength; // of pixels: what is open is raised to this
    float bleeding; // of pixels: what is bounced is multiplied by this
};

// Of the variants: light is bounced back by what hides.
SHARED_CONSTANT uint discs_bounce = 1U;

#ifdef __cplusplus
static_assert(sizeof(Disc) == 32);
static_assert(sizeof(DiscConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
