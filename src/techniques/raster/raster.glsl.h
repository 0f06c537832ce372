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
// Bits of the raster shaders' `variant`, above the bits of the texture classes.
SHARED_CONSTANT uint draw_tests_sides = 1U << 5U;
SHARED_CONSTANT uint draw_has_no_masks = 1U << 6U; // disables masks in shaders that could test them
// Each thread lists the tiles of a triangle that touches few tiles.
SHARED_CONSTANT uint draw_lists_tiles = 1U << 7U;
SHARED_CONSTANT uint bounds_by_thread = 1U; // one thread finds the bounding box of a whole cluster
SHARED_CONSTANT uint cull_drops_backs = 1U; // culls back faces from the list of triangles to draw
// Depth peeling at half resolution draws only every second pixel in x and y. The two bits above draws_second
// give the first pixel.
SHARED_CONSTANT uint draws_second = 1U;

// Selects the triangles to draw and the picture to draw into.
struct RasterConstants {
    mat4 clip_from_anchor;
    uvec2 size_px;
    uint first_triangle;
    uint triangle_count;
    uint large_capacity;
    uint tile_capacity;
    uint cull_back_faces;
    uint small_area_px; // most pixels in the bounding box of a triangle that one thread draws
    uint second;        // pixels to draw in depth peeling at half resolution, see draws_second
    float least_alpha;  // texels of masked batches are drawn from this alpha on, if the mask keeps them
    float alpha_below;  // texels of masked batches are drawn below this alpha
};

// One of many square depth maps that are drawn together.
struct RasterView {
    mat4 clip_from_anchor;
    vec3 eye_anchor;
    float reach_m;    // largest distance from the view's eye of objects that are drawn
    uint first_texel; // first texel in the buffer of all maps; the map's rows are contiguous
    uint size_px;
    uvec2 origin_px; // position of the view's square in the image of the hardware path
    uint groups;     // bits of object groups; the view draws a batch that has one of these bits
    uvec2 turn_px;   // compute path only: position of the map's first texel; the map wraps around at its ends
};

// Bounding box, in anchor space (relative to a nearby origin), of a cluster of 64 consecutive triangles of
// the list.
struct ClusterBounds {
    vec3 low;
    vec3 high;
};

// Selects the triangles to draw and the views to draw into.
struct ViewsConstants {
    uint first_triangle;
    uint triangle_count;
    uint first_view;
    uint view_count;
    uint large_capacity;
    uint tile_capacity;
    uint small_area_px;
    uint groups;    // bits of the batch's object groups
    uvec2 image_px; // hardware path only: size of the image that holds all views
};

// A cluster of triangles that a view may show; one instance of the hardware path's draw call.
struct ClusterInView {
    uint cluster;
    uint view;
};

// A triangle that is too large for one thread. Clipping can split a triangle into part 0 and part 1.
struct LargeTriangle {
    uint triangle;
    uint part_and_view; // triangle's part (after clipping) in bit 0, view above; view 0 if there is only one
};

// A tile of the picture that a large triangle touches.
struct TriangleTile {
    uint triangle;
    // triangle's part (after clipping) in bit 31. Single view: tile row in bits 15-29, column in 0-14. Many
    // views: view in bits 16-30, row in 8-15, column in 0-7.
    uint part_and_tile;
};

// Lengths of the lists of LargeTriangle and of TriangleTile.
struct RasterCounters {
    uint large_count;
    uint tile_count;
};

// A rectangle of a depth picture and its place in a map with longer rows.
struct DepthPartConstants {
    uvec2 from_px;
    uvec2 size_px;
    uint picture_width_px;
    uint row_texels;
    uint first_texel;
};

// Selects the triangles that the hardware path draws, and the picture to draw into.
struct DrawConstants {
    mat4 clip_from_anchor;
    uvec2 size_px;
    uint first_triangle;
    uint triangle_count;
    uint peeled_width_px; // width of the visibility buffer of the previous layer (depth peeling)
    uint second;          // pixels to draw in depth peeling at half resolution, see draws_second
    float least_alpha;    // texels of masked batches are drawn from this alpha on, if the mask keeps them
    float alpha_below;    // texels of masked batches are drawn below this alpha
};

#ifdef __cplusplus
static_assert(sizeof(DepthPartConstants) == 28);
static_assert(sizeof(DrawConstants) == 96);
static_assert(sizeof(RasterConstants) == 108);
static_assert(sizeof(RasterView) == 108);
static_assert(sizeof(ClusterBounds) == 24);
static_assert(sizeof(ViewsConstants) == 40);
} // namespace estampe::shared
#endif

#endif
