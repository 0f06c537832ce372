// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CONTOUR_GLSL_H
#define ESTAMPE_CONTOUR_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint no_seed = 0xffffffffU;

// Variant bits of edges.comp, seeds.comp and stroke.comp.
SHARED_CONSTANT uint edges_has_screen = 1U << 0U;       // there are see-through surfaces
SHARED_CONSTANT uint edges_only_cut = 1U << 1U;         // only what a texture's alpha cuts has lines
SHARED_CONSTANT uint seeds_has_own_outlines = 1U << 0U; // that some material brings
SHARED_CONSTANT uint stroke_has_own_outlines = 1U << 0U;

// Where the surface breaks between a pixel and its neighbours to the right and below.
struct EdgePixel {
    uint pixel;     // y << 16 | x
    uint widths_px; // two halves: whole width of the line to the right and of the one below, 0 for none
};

struct EdgeConstants {
    float outline_px; // whole widths
    float boundary_px;
    float crease_px;
    float crease_cosine;
    float depth_step; // by which a surface must fall away within one pixel: share of the distance, or metres
                      // in parallel projection
    uint capacity;
};

struct SeedConstants {
    float pressure; // 0: even, 1: from hair-thin in the light to double in the shade
    float distance_thinning;
    float pixel_m_at_one; // what a pixel spans at a distance of one, in perspective
    uint capacity;
};

struct FloodConstants {
    uint width;
    uint height;
    uint step_px;
};

struct StrokeConstants {
    uint width;
    uint height;
    float reach_px; // no stroke is wider than twice this
    vec3 ink_color;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
