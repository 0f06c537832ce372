// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PARTICLES_GLSL_H
#define ESTAMPE_PARTICLES_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint particle_tile_px = 32U; // side in pixels of a page tile with a list of sprites

SHARED_CONSTANT uint particles_drawn = 0U;
SHARED_CONSTANT uint particles_wash = 1U;
SHARED_CONSTANT uint particles_blots = 2U;
SHARED_CONSTANT uint particles_strokes = 3U;

// Bits of the particle shaders' `variant`.
SHARED_CONSTANT uint particles_by_groups = 1U; // the pixels of a workgroup read one sprite list together

// A particle projected on the page: three texels of four floats.
struct Sprite {
    vec2 centre_px; // centre of the sprite on the page
    float radius_px;
    float away_m;  // distance from the eye along the view direction
    vec2 turn;     // cosine and sine of the sprite's rotation
    float stretch; // half length of the sprite along its rotated axis, in radii; 1 for round sprites
    float opacity;
    float trait; // random number of the particle, 0 to 1
    float frame; // frame of the sprite sheet, with a fraction
    vec2 unused;
};

struct ParticleTiles {
    uint tiles_across; // number of tiles with sprite lists per row of the page
};

struct ParticleConstants {
    vec3 color;
    float outline_px;
    vec3 ink;
    float soft_m;
    uint look;
    uint tiles_across;
    uvec2 frames; // columns and rows of the sprite sheet; 0 without a sheet
    uvec2 sheet_px;
    // Distance where haze starts, see haze.glsl.h.
    float haze_start_m;
    float haze_halves_per_m; // halvings of contrast per metre of haze; 0: no haze
    float haze_ink;
};

#ifdef __cplusplus
static_assert(sizeof(Sprite) == 48);
} // namespace estampe::shared
#endif

#endif
