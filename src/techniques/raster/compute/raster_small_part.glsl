// SPDX-License-Identifier: MIT
// One thread draws one small triangle, lists the tiles of one that touches few, or puts a large one on the
// list.

#ifndef RASTER_MASKED
layout(constant_id = 0) const uint variant = 0u;
#endif

const int small_side_px = 63; // edge functions of such triangles fit 32 bits
const int most_tiles_a_thread = 4;

void draw_part(ClippedTriangle clipped, uint part, uint view_index, uint triangle, uint flags)
{
    PageTriangle t;
    ivec2 low, high;
    if (!page_part(clipped, part, flags, t)) {
        return;
    }
    pixel_bounds(t, low, high);
    if (any(lessThan(high, low))) {
        return;
    }
    ivec2 extent = max(max(t.p[0], t.p[1]), t.p[2]) - min(min(t.p[0], t.p[1]), t.p[2]);
    ivec2 covered = high - low + 1;
    if (all(lessThan(extent, ivec2(small_side_px * 256))) &&
        uint(covered.x * covered.y) <= constants.small_area_px) {
        fill_small(t, low, high, triangle);
        return;
    }
    ivec2 first = low / tile_px;
    ivec2 across = high / tile_px - first + 1;
    if ((variant & draw_lists_tiles) != 0u && across.x * across.y <= most_tiles_a_thread) {
        for (int k = 0; k < across.x * across.y; ++k) {
            list_tile(t, low, high, first + ivec2(k % across.x, k / across.x), part, view_index, triangle);
        }
        return;
    }
    uint slot = atomicAdd(counters.large_count, 1u);
    if (slot < constants.large_capacity) {
        large_triangles[slot] = LargeTriangle(triangle, view_index << 1 | part);
        return;
    }
#ifdef RASTER_VIEWS
    // A list for all triangles in all views would be too long; what it cannot hold is drawn here: slow, but
    // whole.
    for (int x = low.x; x <= high.x; ++x) {
        fill_column(t, ivec2(x, low.y), high.y, 1, triangle);
    }
#endif
}
