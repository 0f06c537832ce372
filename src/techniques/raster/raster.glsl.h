// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_RASTER_GLSL_H
#define ESTAMPE_RASTER_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

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
};

// A triangle too large for one thread, after clipping: `part` is 0 or 1, since clipping can make two of one.
struct LargeTriangle {
    uint triangle;
    uint part;
};

// A tile of the picture that a large triangle touches.
struct TriangleTile {
    uint triangle;
    uint part_and_tile; // part in bit 31, tile row in bits 15-29, tile column in 0-14
};

// Counts of the two lists above.
struct RasterCounters {
    uint large_count;
    uint tile_count;
};

// The same for the hardware path.
struct DrawConstants {
    mat4 clip_from_anchor;
    uvec2 size_px;
    uint first_triangle;
};

#ifdef __cplusplus
static_assert(sizeof(DrawConstants) == 76);
static_assert(sizeof(RasterConstants) == 96);
inline constexpr uint raster_tile_px = 64;
inline constexpr uint draw_tests_sides = 1U << 5U; // variant bit, above those of the texture classes
} // namespace estampe::shared
#else
#define RASTER_TILE_PX 64
#define DRAW_TESTS_SIDES (1u << 5)
#endif

#endif
