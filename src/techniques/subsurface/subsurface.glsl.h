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
// Side in pixels of a square of the page, which one workgroup processes.
SHARED_CONSTANT uint scatter_square_px = 16U;
SHARED_CONSTANT uint most_texture_levels = 8U;
// Most pixels of the background, in one direction, that one pixel of a body averages if the body bends light.
SHARED_CONSTANT float bent_footprint_px = 8.0F;
// Least share of the background that is visible through a body which shows the lines behind itself.
SHARED_CONSTANT float least_line_share = 0.5F;
SHARED_CONSTANT uint behind_levels = 6U; // number of background images: full size, half size, and so on

// Subsurface parameters of a material: three texels of 16 bytes.
struct SubsurfaceParameters {
    vec3 absorbed_per_m; // absorption coefficient of the body per colour
    float strength;      // factor on transmitted light; 0: no transmission
    vec3 scatter_m;      // scattering distance d per colour; 0: no scattering
    float sheet_m;       // assumed thickness of a body without a far side (a sheet)
    float behind;        // share of the background that is visible through the body
    float behind_blur;   // standard deviation of the background's blur per metre of thickness
    float behind_tint;   // weight of the surface's own colour in the background's tint
    float ior;           // index of refraction of a clear body; 1: the view ray passes straight
};

// Constants of scattering passes. The half page has every second pixel in x and y, at even positions. The
// half-page pixel at the index `i` is the page's pixel 2 * (from_half + i).
struct ScatterConstants {
    uvec2 from_half;
    uvec2 half_px;
    float most_px; // largest scattering distance d, in pixels of the page
    // Number of the blur; its taps (pixels read) are 2^level pixels apart, and number 0 is the narrowest
    // blur. In the source pass, the count of blurs.
    int level;
    uint is_last; // 1 in the last blur, which also replaces all wider Gaussians
};

// Constants of a map that covers all surfaces, in which light spreads between texels.
struct TextureConstants {
    uint size;     // texels per side of the map
    float most_tx; // largest scattering distance d, in texels
    int level;     // number of the blur, 0 the narrowest; its taps (texels read) are 2^level texels apart
    uint is_last;  // 1 in the last blur, which also replaces all wider Gaussians
};

// Bits of the subsurface shaders' `variant`.
SHARED_CONSTANT uint subsurface_has_variants = 1U; // there are several sets of subsurface parameters
SHARED_CONSTANT uint subsurface_is_upright = 2U;
SHARED_CONSTANT uint subsurface_shines = 4U;  // light is transmitted from the bodies' far side
SHARED_CONSTANT uint subsurface_spreads = 8U; // light spreads below the surface
// The shader reads neighbours only where they affect the result, which is faster on CPUs. GPUs read all
// neighbours, so that no load waits for another.
SHARED_CONSTANT uint subsurface_looks_less = 16U;
SHARED_CONSTANT uint subsurface_in_perspective = 32U;

#ifdef __cplusplus
static_assert(sizeof(SubsurfaceParameters) == 48);
} // namespace estampe::shared
#endif

#endif
