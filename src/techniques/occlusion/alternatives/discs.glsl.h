// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISCS_GLSL_H
#define ESTAMPE_DISCS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint disc_children = 8U;    // number of children of a node in the tree of discs
SHARED_CONSTANT uint most_disc_levels = 9U; // most levels of the tree of discs, including the level of discs

// A disc, or the sum of all discs below a tree node: two texels of 16 bytes.
struct Disc {
    vec3 place;
    float radius_m; // radius of a ball that holds the centres of all discs; 0 for a single disc
    vec3 facing_m2; // sum of the discs' normals, each times its area
    float area_m2;  // sum of the discs' areas
};

// The tree of discs and the settings of the sum. The tree's levels are stored one after another, discs first;
// the level with the index i has `counts[i]` nodes.
struct DiscConstants {
    uint counts[most_disc_levels];
    uint level_count;
    uint level;     // tree level that the pass computes
    float radius_m; // largest distance of a disc that occludes, in metres
    float apart;    // a tree node counts as one disc if its radius is less than `apart` times its distance
    float strength; // exponent of the visibility, used in passes over pixels
    float bleeding; // factor on bounced light, used in passes over pixels
};

// Bit of `variant`: discs also bounce light.
SHARED_CONSTANT uint discs_bounce = 1U;

#ifdef __cplusplus
static_assert(sizeof(Disc) == 32);
static_assert(sizeof(DiscConstants) <= 128);
} // namespace estampe::shared
#endif

#endif
