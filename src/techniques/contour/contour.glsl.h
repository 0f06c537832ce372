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

// Variant bits: each bit compiles one feature into the shader edges.comp, seeds.comp or stroke.comp. The
// first word of a bit's name is the shader's name.
SHARED_CONSTANT uint edges_has_screen = 1U << 0U; // the scene has see-through surfaces
SHARED_CONSTANT uint edges_only_cut = 1U << 1U;   // draws lines only where a texture's alpha cuts the surface
SHARED_CONSTANT uint edges_has_clumps = 1U << 2U; // foliage has lines around clumps, and none around leaves
// At least one material sets the ink and width of its outline.
SHARED_CONSTANT uint seeds_has_own_outlines = 1U << 0U;
SHARED_CONSTANT uint stroke_has_own_outlines = 1U << 0U;

// A pixel at which a line is drawn, because the visible surface ends, folds or changes its material between
// the pixel and the pixel to the right or below.
struct EdgePixel {
    uint pixel; // position of the pixel: y << 16 | x
    // Full widths in pixels of two lines, as half floats: the line between the pixel and its right neighbour,
    // and the line between the pixel and the one below. 0 means no line.
    uint widths_px;
};

struct SpareConstants {
    uvec2 size_px;
    uint reach_px; // largest distance of a pixel from a place that must be black, too
    float spared;  // share of a line that is left white
};

struct EdgeConstants {
    float outline_px;  // full width of outlines in pixels
    float boundary_px; // full width in pixels of boundaries, which separate materials
    float crease_px;   // full width of creases in pixels
    float crease_cosine;
    // Smallest change of depth within one pixel that makes a line: a share of the distance from the eye, or
    // metres in parallel projection.
    float depth_step;
    uint capacity;
};

struct SeedConstants {
    // Effect of pressure on width: 0: no effect; 1: lines are hair-thin in light and twice as wide in shade.
    float pressure;
    float distance_thinning;
    // Size of a pixel in metres of the scene, at a distance of one metre from the eye. In parallel
    // projection, the size is equal at all distances.
    float pixel_m_at_one;
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
    float reach_px; // half the width of the widest line, in pixels
    vec3 ink_color;
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
