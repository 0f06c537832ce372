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
SHARED_CONSTANT uint edges_has_screen = 1U << 0U; // see-through surfaces exist
SHARED_CONSTANT uint edges_only_cut = 1U << 1U;   // lines only where the alpha of a texture cuts the surface
SHARED_CONSTANT uint seeds_has_own_outlines = 1U << 0U; // some material has its own outline
SHARED_CONSTANT uint stroke_has_own_outlines = 1U << 0U;

// Breaks of the surface between a pixel and its neighbours to the right and below.
struct EdgePixel {
    uint pixel;     // y << 16 | x
    uint widths_px; // two halves: full width of the line to the right and of the one below, 0 for no line
};

struct EdgeConstants {
    float outline_px;  // full width of outlines
    float boundary_px; // full width of boundaries
    float crease_px;   // full width of creases
    float crease_cosine;
    float depth_step; // smallest change of depth within one pixel that makes a line: a share of the distance,
                      // or metres in parallel projection
    uint capacity;
};

struct SeedConstants {
    float pressure; // 0: constant width; 1: from hair-thin in the light to double width in the shade
    float distance_thinning;
    float pixel_m_at_one; // size of a pixel at a distance of one, in perspective
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
    float reach_px; // half the width of the widest stroke
    vec3 ink_color;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
