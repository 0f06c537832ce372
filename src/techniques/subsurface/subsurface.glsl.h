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
SHARED_CONSTANT uint scatter_square_px = 16U; // side of a square of the page, which one workgroup processes
SHARED_CONSTANT uint most_texture_levels = 8U;
SHARED_CONSTANT uint behind_levels = 6U; // images of the background: full size, half size, and so on

// Subsurface parameters of a material: three texels of 16 bytes.
struct SubsurfaceParameters {
    vec3 absorbed_per_m; // absorption coefficient per colour
    float strength;      // factor on transmitted light; 0: none
    vec3 scatter_m;      // scattering distance d per colour; 0: none
    float sheet_m;       // assumed thickness of a body without a far side
    float behind;        // visible share of the background
    float behind_blur;   // standard deviation of the background's blur per thickness
    float behind_tint;   // weight of the surface's own colour in the background's tint
    float unused;
};

// The half page has every second pixel in x and y, at even positions. Pixel `i` is page pixel 2 * (from_half
// + i).
struct ScatterConstants {
    uvec2 from_half;
    uvec2 half_px;
    float most_px; // largest d on the page
    // Blur level, 0 is the narrowest, with taps 2^level apart; in the source pass, the number of levels.
    int level;
    uint is_last; // 1: last level, which also takes all wider Gaussians
};

// A map that covers all surfaces, in which light spreads between texels.
struct TextureConstants {
    uint size;     // texels per side
    float most_tx; // largest d, in texels
    int level;     // blur level, 0 is the narrowest; taps are 2^level apart
    uint is_last;  // 1: last level, which also takes all wider Gaussians
};

// Variant bits.
SHARED_CONSTANT uint subsurface_has_variants = 1U; // there are several parameter sets
SHARED_CONSTANT uint subsurface_is_upright = 2U;
SHARED_CONSTANT uint subsurface_shines = 4U;  // light is transmitted from the far side
SHARED_CONSTANT uint subsurface_spreads = 8U; // light spreads below the surface
// Reads neighbours only where they affect the result, for CPUs. GPUs read all neighbours, so that no load
// waits for another.
SHARED_CONSTANT uint subsurface_looks_less = 16U;
SHARED_CONSTANT uint subsurface_in_perspective = 32U;

#ifdef __cplusplus
static_assert(sizeof(SubsurfaceParameters) == 48);
} // namespace estampe::shared
#endif

#endif
