// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RASTER_GLSL_H
#define ESTAMPE_RASTER_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint cluster_triangles = 64U;
SHARED_CONSTANT uint raster_tile_px = 64U;
// Bits of the variants, above those of the texture classes.
SHARED_CONSTANT uint draw_tests_sides = 1U << 5U;
SHARED_CONSTANT uint draw_has_no_masks = 1U << 6U; // of shaders that could test them
SHARED_CONSTANT uint draw_lists_tiles = 1U << 7U;  // a thread does, of a triangle that touches few
SHARED_CONSTANT uint bounds_by_thread = 1U;        // a thread finds the box of a whole cluster
SHARED_CONSTANT uint cull_drops_backs = 1U;        // of the list that is drawn from
// Of peels that draw but every second pixel each way; the two bits above it say at which they begin.
SHARED_CONSTANT uint draws_second = 1U;

// Which triangles to draw into which picture.
struct RasterConstants {
    mat4 clip_from_anchor;
    uvec2 size_px;
    uint first_triangle;
    uint triangle_count;
    uint large_capacity;
    uint tile_capacity;
    uint cull_back_faces;
    uint small_area_px; // up to this many pixels of bounding box one thread draws a triangle whole
    uint second;        // of peels, see draws_second
};

// One square depth map of many that are drawn together.
struct RasterView {
    mat4 clip_from_anchor;
    vec3 eye_anchor;
    float reach_m;    // nothing farther from the eye is wanted
    uint first_texel; // in the buffer of all maps; rows follow one another
    uint size_px;
    uvec2 origin_px; // in the image that the hardware path draws into
    uint groups;     // shows the batches that share a bit
    uvec2 turn_px;   // compute: where its first texel stands; what would go over an end goes on at the other
};

// Box about 64 consecutive triangles of the list, as they stand in anchor space.
struct ClusterBounds {
    vec3 low;
    vec3 high;
};

// Which triangles to draw into which views.
struct ViewsConstants {
    uint first_triangle;
    uint triangle_count;
    uint first_view;
    uint view_count;
    uint large_capacity;
    uint tile_capacity;
    uint small_area_px;
    uint groups;    // of the batch
    uvec2 image_px; // hardware: of the image that holds all views
};

// A cluster that a view may show: what an instance of the hardware path draws.
struct ClusterInView {
    uint cluster;
    uint view;
};

// A triangle too large for one thread, after clipping: the part is 0 or 1, since clipping can make two of
// one.
struct LargeTriangle {
    uint triangle;
    uint part_and_view; // part in bit 0, view above; 0 where there is one view
};

// A tile of the picture that a large triangle touches.
struct TriangleTile {
    uint triangle;
    uint part_and_tile; // part in bit 31; of one view tile row in bits 15-29, tile column in 0-14; of many
                        // the view in bits 16-30, row in 8-15, column in 0-7
};

// Counts of the two lists above.
struct RasterCounters {
    uint large_count;
    uint tile_count;
};

// A rectangle of a depth picture, and where it goes in a map of longer rows.
struct DepthPartConstants {
    uvec2 from_px;
    uvec2 size_px;
    uint picture_width_px;
    uint row_texels;
    uint first_texel;
};

// The same for the hardware path.
struct DrawConstants {
    mat4 clip_from_anchor;
    uvec2 size_px;
    uint first_triangle;
    uint triangle_count;
    uint peeled_width_px; // of the picture that is peeled
    uint second;          // of peels, see draws_second
};

#ifdef __cplusplus
static_assert(sizeof(DepthPartConstants) == 28);
static_assert(sizeof(DrawConstants) == 88);
static_assert(sizeof(RasterConstants) == 100);
static_assert(sizeof(RasterView) == 108);
static_assert(sizeof(ClusterBounds) == 24);
static_assert(sizeof(ViewsConstants) == 40);
} // namespace estampe::shared
#endif

#endif
