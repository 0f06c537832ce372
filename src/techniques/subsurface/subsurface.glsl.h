// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUBSURFACE_GLSL_H
#define ESTAMPE_SUBSURFACE_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint most_scatter_levels = 7U;
SHARED_CONSTANT uint scatter_square_px = 16U; // of the page, which is listed by such squares, a group each
SHARED_CONSTANT uint most_texture_levels = 8U;
SHARED_CONSTANT uint behind_levels = 6U; // of what lies behind: whole, in halves, and so on

// What a look says of light that goes in: three texels of 16 bytes.
struct SubsurfaceLook {
    vec3 absorbed_per_m; // logarithm of what is lost
    float strength;      // of light that comes through; 0: none does
    vec3 scatter_m;      // how far each colour spreads: d of the profile; 0: none does
    float sheet_m;       // thickness of what has no far side
    float behind;        // share of what lies behind that is seen
    float behind_blur;   // deviation of its blur, by the thickness
    float behind_tint;   // share of the surface's own colour that tints it
    float unused;
};

// Every second pixel of the page each way, those at even places, as `from_half` tells: pixel `i` is pixel 2 *
// (from_half + i) of the page.
struct ScatterConstants {
    uvec2 from_half;
    uvec2 half_px;
    float most_px; // that d may be on the page
    int level;     // of the blur, 0 the narrowest: taps are two to this power apart; of the source, how many
    uint is_last;  // level: what is wider goes with it
};

// The texels of a map that lies on all surfaces, which light spreads between.
struct TextureConstants {
    uint size;     // of the map, texels a side
    float most_tx; // that d may be, in texels
    int level;     // of the blur, 0 the narrowest: taps are two to this power apart
    uint is_last;  // level: what is wider goes with it
};

// Bits of the variants.
SHARED_CONSTANT uint subsurface_has_looks = 1U; // surfaces differ
SHARED_CONSTANT uint subsurface_is_upright = 2U;
SHARED_CONSTANT uint subsurface_shines = 4U;  // light comes through from the far side
SHARED_CONSTANT uint subsurface_spreads = 8U; // light comes out beside where it went in
// Neighbours are looked at only where they count: on a GPU all are, by loads that do not wait for one
// another.
SHARED_CONSTANT uint subsurface_looks_less = 16U;
SHARED_CONSTANT uint subsurface_in_perspective = 32U;

#ifdef __cplusplus
static_assert(sizeof(SubsurfaceLook) == 48);
} // namespace estampe::shared
#endif

#endif
